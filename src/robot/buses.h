// The buses over which a robot's computer reaches its motors.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "robot/robot_spec.h"

namespace understudy::robot {

// The motors behind one bus.
struct MotorBus {
  std::string name{};                 // "" of those that are on no bus of the description
  std::vector<std::size_t> motors{};  // in motor order
  std::array<double, 2> delay{};      // s, least and most that a command takes
};

// Returns the buses of the description, those of its hands, each named HAND_hand, and at last that
// of all other motors if there are any.
std::vector<MotorBus> BusesOf(const RobotSpec& spec);

}  // namespace understudy::robot
