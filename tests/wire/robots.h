// Two small robots for wire tests. Slots have gaps, so that a slot is never its motor's index.
#pragma once

#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// The step in which that message, and no other, is due; in steps of kTimestep.
inline constexpr std::int64_t kLowStateStep = 2, kMotionStep = 3, kHandStep = 5, kLfStep = 7;
inline constexpr double kTimestep = 0.001;
inline const robot::RateSpec kRates{.lowstate_hz = 1000.0 / kLowStateStep,
                                    .motion_hz = 1000.0 / kMotionStep,
                                    .lf_hz = 1000.0 / kLfStep};

// Three motors, two feet, eight cells.
inline robot::RobotSpec GoRobot() {
  robot::RobotSpec spec;
  spec.name = "go";
  spec.family = robot::WireFamily::kGo;
  spec.motors = {{.joint = "a", .slot = 1}, {.joint = "b", .slot = 4}, {.joint = "c", .slot = 19}};
  spec.feet = {{.name = "FR", .geoms = {}}, {.name = "FL", .geoms = {}}};
  spec.foot_sensor = {.offset_counts = 15, .counts_per_newton = 0.5};
  spec.battery.cells = 8;
  spec.rates = kRates;
  return spec;
}

// Four motors of which "roll" (index 1) and "pitch" (index 2) are a parallel pair; 13 cells, two
// inertial units.
inline robot::RobotSpec HgRobot() {
  robot::RobotSpec spec;
  spec.name = "hg";
  spec.family = robot::WireFamily::kHg;
  spec.mode_machine = 5;
  spec.motors = {{.joint = "knee", .slot = 2},
                 {.joint = "roll", .slot = 4},
                 {.joint = "pitch", .slot = 7},
                 {.joint = "hand", .slot = 34}};
  spec.parallel = {{.pitch = 2, .roll = 1, .roll_ratio = 0.5}};
  spec.imu.secondary_site = "torso";
  spec.battery.cells = 13;
  spec.rates = kRates;
  return spec;
}

inline robot::RobotState StateOf(const robot::RobotSpec& spec) {
  robot::RobotState state;
  state.motors.resize(robot::AllMotors(spec).size());
  state.foot_force.resize(spec.feet.size());
  return state;
}

inline robot::RobotCommand CommandOf(const robot::RobotSpec& spec) {
  return {.motors = std::vector<robot::MotorCommand>(spec.motors.size())};
}

}  // namespace understudy::wire
