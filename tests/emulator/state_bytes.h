// Converts a state to bytes, for comparisons bit for bit.
#pragma once

#include <string>

#include "robot/robot_values.h"

namespace understudy::emulator {

// The readings of motors, units, feet, battery, base, remote controller and motion service, one
// after the other and without padding. Touch, board, odometry and truth are not among them.
std::string Bytes(const robot::RobotState& state);

}  // namespace understudy::emulator
