// The settings of the world and of each of its robots.
#pragma once

#include <string>
#include <vector>

#include "authority/command_gate.h"
#include "authority/motion_config.h"
#include "physics/crane.h"
#include "robot/fault_bank.h"
#include "robot/start_pose.h"
#include "sensors/sensor_config.h"

namespace understudy::emulator {

// What a key of the configuration takes, for those that can change while a robot runs; config::
// SettingKeys makes them of the rows that read the configuration.
struct SettingKey {
  std::string key;                   // dotted
  std::string unit;                  // "" if there is none
  std::string does;                  // a sentence
  std::string expected;              // "a number from 0 to 100"
  double low = 0, high = 0;          // of a number, both ends included
  std::vector<std::string> words{};  // not empty: it is one of two; of a switch false, true

  bool is_switch() const { return !words.empty() && words.front() == "false"; }
};

struct WorldSettings {
  double speed = 1;                  // simulated s per wall s at the start; 0 = as fast as possible
  bool reset_on_divergence = false;  // put the robots back to their start poses
  double ground_friction = 0;        // as terrain.friction
  std::vector<SettingKey> keys{};    // in the order of LiveSettings; none: none can change
};

// The settings of a robot, validated: its pose and service exist.
struct RobotSettings {
  sensors::SensorConfig sensors;
  authority::GateConfig gate;
  authority::MotionConfig motion;
  physics::CraneConfig crane;
  robot::StartPose start = robot::StartPose::kLying;
  bool boot = false;  // is switched on at the start, else has booted
  std::vector<robot::PlannedFault> faults{};
};

}  // namespace understudy::emulator
