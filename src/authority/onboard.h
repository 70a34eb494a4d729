// Finds the programs on a robot's computer at the start of a run.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "authority/motion_config.h"
#include "authority/motor_owner.h"
#include "robot/robot_spec.h"

namespace understudy::authority {

// Returns the aliases of the motion services of the robot's firmware, in the order of its
// description.
std::vector<std::string> MotionServices(const robot::RobotSpec& spec);

// Returns the motion service of the robot's firmware with that alias, which must be one of them.
const robot::ServiceSpec& MotionService(const robot::RobotSpec& spec, std::string_view alias);

// Returns the one that is on at the start; "" for none. `config.service` must be one of them,
// kNoService or "".
std::string StartService(const robot::RobotSpec& spec, const MotionConfig& config);

// Returns all programs of the firmware. Of the motion services only `on` is switched on.
std::vector<OnboardService> OnboardServices(const robot::RobotSpec& spec, std::string_view on);

// Returns the program that drives a hand, as robot_state lists it; "" if it lists none for such
// hands. One that a robot lists and has switched off is as dead.
std::string_view HandProgram(const robot::HandSpec& hand);

}  // namespace understudy::authority
