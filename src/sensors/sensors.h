// Simulates the sensors: encoders, IMUs, feet and gauges.
#pragma once

#include <cstdint>
#include <vector>

#include "physics/robot_body.h"
#include "robot/battery.h"
#include "robot/board.h"
#include "robot/fault.h"
#include "robot/motor.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"
#include "sensors/chance.h"
#include "sensors/encoders.h"
#include "sensors/foot_sensors.h"
#include "sensors/imu_unit.h"
#include "sensors/leg_odometer.h"
#include "sensors/odometer.h"
#include "sensors/sensor_config.h"
#include "sensors/thermometers.h"
#include "sensors/touch_sensors.h"

namespace understudy::sensors {

// Returns by how much [rad] each encoder reads more than there is, in motor order: what is drawn
// for it and robot.motors[].zero_error.
std::vector<double> EncoderZeros(const SensorConfig& config, const robot::RobotSpec& spec);

// What there is to be measured.
struct Instant {
  const physics::RobotBody& robot;
  const Encoders& encoders;
  const robot::MotorBank& motors;
  const robot::RobotCommand& command;  // that the motors followed
  const robot::Battery& battery;
  const robot::Board& board;
  const robot::Effects& faults;
  bool feels = true;  // whether somebody reads what the pads of hands show
};

// The robot's sensors. Call Restart first, Step in every physics step, and Sample after it when a
// message is due; all after World::EndStep, when all
// readings of robot, motors and battery belong to the same t. Without errors, noise and
// quantisation the sample is the truth. Equal seeds and worlds give bit-identical samples.
// Allocates only in the constructor and in the first Sample into a state.
//
// Body and hands have separate noise streams, so hands do not change the body's noise; nor do other
// errors.
class Sensors {
 public:
  // `spec` must outlive the sensors; `dt` [s] is the physics step.
  Sensors(const SensorConfig& config, const robot::RobotSpec& spec, double dt);

  // Begins anew with a robot at rest: filters, latencies and walks. What was drawn stays.
  void Restart(const Instant& instant);
  // Goes on with other errors from the next step on: what was drawn is scaled, walks, filters and
  // noise go on from where they are. All but seed, imu.latency, imu.attitude and encoder may
  // differ. Allocates nothing.
  void Apply(const SensorConfig& config);
  void Step(const Instant& instant);
  // Fills `state`, which has the previous sample. Leaves its tick_ms, remote and motion, and its
  // touch where nobody reads it.
  void Sample(const Instant& instant, robot::RobotState* state);

 private:
  // Noise and resolution of one figure of a motor: white noise of that standard deviation.
  struct Resolution {
    bool noisy = false;
    double sigma = 0, step = 0;  // 0: not rounded
  };
  struct MotorResolution {
    Resolution q, dq, tau;
  };

  void ApplyNoise(const SensorConfig& config);
  void Feel(const Instant& instant, robot::RobotState* state);
  static double Sampled(double truth, const Resolution& resolution, Noise* noise);

  const robot::RobotSpec& spec_;
  std::vector<const robot::MotorSpec*> motors_;
  std::vector<MotorResolution> resolutions_;
  std::vector<double> foot_force_;  // N
  ImuUnit imu_, secondary_imu_;
  robot::ImuReading told_imu_;  // of LowState, of the last step
  Odometer odometer_;
  LegOdometer legs_;
  FootSensors feet_;
  TouchSensors touch_;
  std::vector<float> touch_force_;  // N, by cell
  Thermometers windings_, casings_;
  Noise body_, hands_;
};

}  // namespace understudy::sensors
