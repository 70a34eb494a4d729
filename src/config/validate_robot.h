// Checks conditions that span several keys of a robot.
#pragma once

#include <string>

#include "config/checker.h"
#include "robot/robot_spec.h"

namespace understudy::config {

// Throws ConfigError for the first failed condition: the robot must have a name, a model and
// motors; slots must ascend and exist in the message family; speeds, poses, parallel pairs and
// battery voltages must be consistent.
void ValidateRobot(const robot::RobotSpec& robot, const Checker& checker);

// Throws ConfigError unless `pose`, the value of `key`, is a start pose.
void CheckStartPose(const std::string& pose, const std::string& key, const Checker& checker);

}  // namespace understudy::config
