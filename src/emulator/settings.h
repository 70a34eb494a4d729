// The settings of the world and of each of its robots.
#pragma once

#include <span>
#include <vector>

#include "authority/command_gate.h"
#include "authority/motion_config.h"
#include "physics/crane.h"
#include "robot/fault_bank.h"
#include "robot/start_pose.h"
#include "schema/entries.h"
#include "sensors/sensor_config.h"

namespace understudy::emulator {

struct WorldSettings {
  double speed = 1;                  // simulated s per wall s at the start; 0 = as fast as possible
  bool reset_on_divergence = false;  // put the robots back to their start poses
  double ground_friction = 0;        // as terrain.friction
  // What the live keys take, in the order of LiveSettings (config::SettingKeys); none: none can
  // change.
  std::span<const schema::Entry> keys{};
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
