// The topics that a robot tells its states on, without a bus.
#pragma once

#include <string>
#include <vector>

#include "robot/robot_spec.h"

namespace understudy::wire {

// Returns what Port::topics() is of such a robot, in its order.
std::vector<std::string> StateTopics(const robot::RobotSpec& spec);

}  // namespace understudy::wire
