// Converts a state to bytes, for comparisons bit for bit.
#pragma once

#include <string>

#include "robot/robot_values.h"

namespace understudy::emulator {

// All readings, one after the other and without padding.
std::string Bytes(const robot::RobotState& state);

}  // namespace understudy::emulator
