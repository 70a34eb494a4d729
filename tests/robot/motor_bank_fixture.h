// Steps a bank of three motors, two of which drive a parallel joint.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "robot/motor.h"

namespace understudy::robot {

// Heat of 0.1 W/(N·m)², which rises by 0.2 °C/W in the winding and by 0.8 in the casing.
inline MotorTypeSpec Type() {
  return {.name = "type",
          .rated_v = 40,
          .watt_per_nm2 = 0.1,
          .winding_c_per_w = 0.2,
          .casing_c_per_w = 0.8,
          .winding_time = 10,
          .casing_time = 100};
}

// Three motors; 1 and 2 are the pitch and roll of a parallel joint.
inline RobotSpec Spec() {
  RobotSpec spec;
  spec.motor_types = {Type()};
  spec.motors.resize(3, MotorSpec{.joint = {}, .torque_limit = 1000, .type = "type"});
  spec.parallel = {{.pitch = 1, .roll = 2, .roll_ratio = 2}};
  spec.thermal = {.ambient_c = 20, .rest_rise_c = 5};
  return spec;
}

inline RobotCommand Torques(double first, double second, double third) {
  RobotCommand command;
  for (const double tau : {first, second, third}) {
    command.motors.push_back({.enabled = true, .tau = tau});
  }
  return command;
}

inline RobotCommand InMotorSpace(RobotCommand command) {
  for (MotorCommand& motor : command.motors) motor.space = JointSpace::kMotors;
  return command;
}

class MotorBankTest : public testing::Test {
 protected:
  static constexpr double kDt = 0.05;  // two steps to a period of heat

  std::span<const double> Step(MotorBank* bank, const RobotCommand& command) {
    return bank->Step({.command = command, .q = q_, .dq = dq_});
  }
  std::vector<double> TorquesOf(MotorBank* bank, const RobotCommand& command) {
    const auto tau = Step(bank, command);
    return {tau.begin(), tau.end()};
  }
  void Work(MotorBank* bank, const RobotCommand& command, double seconds) {
    for (int i = 0; i < std::lround(seconds / kDt); ++i) Step(bank, command);
  }
  // The temperature at which the winding ends, by watts and a resistance that grows with it.
  static double Hot(double watt, double c_per_w) {
    double rise = 0;
    for (int i = 0; i < 100; ++i) rise = c_per_w * watt * (1 + 0.00393 * rise);
    return 25 + rise;
  }

  const RobotSpec spec_ = Spec();
  MotorBank bank_{spec_, kDt};
  std::vector<double> q_ = {0, 0, 0};
  std::vector<double> dq_ = {0, 0, 0};
};

}  // namespace understudy::robot
