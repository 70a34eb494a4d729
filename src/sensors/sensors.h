// What the robot's sensors make of the world.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "physics/robot_body.h"
#include "robot/battery.h"
#include "robot/motor.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::sensors {

struct SensorConfig {
  bool quantise = true;  // round to the encoders' and the IMU's own lattices
  bool noise = true;     // add the noise of a robot at rest
  int seed = 1;          // of that noise
};

// Samples one instant: call after World::EndStep, when every reading of robot, motors and
// battery is of the same t. With noise and quantisation off the sample is the truth. Two samplers
// with the same seed and the same worlds give the same states, bit for bit.
//
// The body's units and the encoders of hands each draw their noise from a stream of their own, so
// that a robot with hands has the body's noise of one without.
class Sensors {
 public:
  // `spec` must outlive the sensors.
  Sensors(const SensorConfig& config, const robot::RobotSpec& spec);

  // Fills `state` for step time tick_ms. `command` is what the motors followed. Does not touch
  // state->remote and state->motion.
  void Sample(const physics::RobotBody& robot, const robot::MotorBank& motors,
              const robot::RobotCommand& command, const robot::Battery& battery,
              std::int64_t tick_ms, robot::RobotState* state);

 private:
  // A random number of mean 0 and deviation 1, independent of the last: that noise is white and of
  // bell shape is *assumed*. The sum of four uniform ones, never beyond 3.5: 6 ns where a normal
  // one takes 23, and the same on every standard library.
  static double Bell(std::mt19937_64* random);
  double Measure(double truth, double sigma, double step, std::mt19937_64* random) const;
  robot::ImuReading Measure(const robot::ImuReading& truth);

  SensorConfig config_;
  const robot::RobotSpec& spec_;
  std::vector<const robot::MotorSpec*> motors_;
  std::mt19937_64 body_, hands_;
};

}  // namespace understudy::sensors
