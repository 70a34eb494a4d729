// The topics on which a robot publishes its states, without a bus.
#pragma once

#include <string>
#include <vector>

#include "robot/robot_spec.h"

struct dds_topic_descriptor;

namespace understudy::wire {

struct StateTopic {
  std::string name;
  const dds_topic_descriptor* type;
};

// Returns the topics of such a robot, in the order of Port::topics().
std::vector<StateTopic> StateTopics(const robot::RobotSpec& spec);

}  // namespace understudy::wire
