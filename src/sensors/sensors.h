// Simulates the sensors: encoders, IMUs, feet and gauges.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "physics/robot_body.h"
#include "robot/battery.h"
#include "robot/encoders.h"
#include "robot/fault.h"
#include "robot/motor.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::sensors {

struct SensorConfig {
  bool quantise = true;  // round to the lattices of encoders and IMU
  bool noise = true;     // add the noise of a robot at rest
  int seed = 1;          // of the noise
};

// What there is to be measured.
struct Instant {
  const physics::RobotBody& robot;
  const robot::Encoders& encoders;
  const robot::MotorBank& motors;
  const robot::RobotCommand& command;  // that the motors followed
  const robot::Battery& battery;
  const robot::Effects& faults;
};

// Samples one instant: call it after World::EndStep, when all readings of robot, motors and battery
// belong to the same t. Without noise and quantisation the sample is the truth. Equal seeds and
// worlds give bit-identical samples.
//
// Body and hands have separate noise streams, so hands do not change the body's noise.
class Sensors {
 public:
  // `spec` must outlive the sensors.
  Sensors(const SensorConfig& config, const robot::RobotSpec& spec);

  // Fills `state`, which has the sample before, for time tick_ms [ms]. Leaves state->remote and
  // state->motion.
  void Sample(const Instant& instant, std::int64_t tick_ms, robot::RobotState* state);

 private:
  // Returns a random number with mean 0 and standard deviation 1. That noise is white and
  // bell-shaped is *assumed*. It is the sum of four uniform numbers, at most 3.5 in magnitude,
  // which takes 6 ns instead of the 23 of a normal one and is equal with every standard library.
  static double Bell(std::mt19937_64* random);
  double Measure(double truth, double sigma, double step, std::mt19937_64* random) const;
  void Measure(const robot::ImuReading& truth, const robot::ImuEffects& fault,
               robot::ImuReading* imu);

  SensorConfig config_;
  const robot::RobotSpec& spec_;
  std::vector<const robot::MotorSpec*> motors_;
  std::vector<double> foot_force_;  // N
  std::mt19937_64 body_, hands_;
};

}  // namespace understudy::sensors
