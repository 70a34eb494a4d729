// A robot's description without one of its motors.
#pragma once

#include <cstddef>

#include "robot/robot_spec.h"

namespace understudy::robot {

// Takes the motor at place `i` of motor order out, with its place in every pose, the parallel pair
// it is in and its slot in rt/arm_sdk. A pose that has not one angle per motor stays as it is.
void DropMotor(std::size_t i, RobotSpec* spec);

}  // namespace understudy::robot
