// Removes a motor from a robot's description.
#pragma once

#include <cstddef>

#include "robot/robot_spec.h"

namespace understudy::robot {

// Removes the motor at index `i` of motor order, with its angle in every pose, its parallel pair
// and its slot in rt/arm_sdk. A pose without one angle per motor does not change.
void DropMotor(std::size_t i, RobotSpec* spec);

}  // namespace understudy::robot
