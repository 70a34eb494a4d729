// The programs on a robot's own computer as a run begins.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "authority/motion_config.h"
#include "authority/motor_owner.h"
#include "robot/robot_spec.h"

namespace understudy::authority {

// Aliases of the motion services that the robot's firmware has, in the order of its description.
std::vector<std::string> MotionServices(const robot::RobotSpec& spec);

// Which of them is on at the start; "" for none. `config.service` must be one of them, kNoService
// or "".
std::string StartService(const robot::RobotSpec& spec, const MotionConfig& config);

// All services of that firmware, of the motion services only the one `on` on.
std::vector<OnboardService> OnboardServices(const robot::RobotSpec& spec, std::string_view on);

}  // namespace understudy::authority
