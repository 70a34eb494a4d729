// What has to fit together within a robot.
#pragma once

#include <string>

#include "config/checker.h"
#include "robot/robot_spec.h"

namespace understudy::config {

// Throws ConfigError at the first thing that does not fit: a robot without name, model or motors;
// slots that are not ascending or that the message family lacks; speeds, poses, parallel pairs and
// battery voltages that contradict each other.
void ValidateRobot(const robot::RobotSpec& robot, const Checker& checker);

// `pose`, the value of `key`, is one to start in.
void CheckStartPose(const std::string& pose, const std::string& key, const Checker& checker);

}  // namespace understudy::config
