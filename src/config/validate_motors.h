// Checks a robot's motors and those of its hands: names, types, slots and pairs.
#pragma once

#include "config/checker.h"
#include "robot/robot_spec.h"

namespace understudy::config {

// Motors that fit into one message: unitree_go LowCmd_.motor_cmd[20], unitree_hg's [35].
int SlotsOf(const robot::RobotSpec& robot);

// Throws ConfigError with the key of the first that is wrong.
void ValidateMotors(const robot::RobotSpec& robot, const Checker& checker);

}  // namespace understudy::config
