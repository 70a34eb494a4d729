// What a robot publishes, as rows: each a message, its topics with their rates, and how it is made.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "robot/robot_spec.h"
#include "wire/publication.h"

namespace understudy::wire {

struct StateRow {
  std::vector<StateTopic> topics;
  // Throws BusError if Cyclone refuses; `timestep` [s] is that of the physics.
  std::function<std::unique_ptr<Publication>(const bus::Participant&, double timestep)> open;
};

// Returns the rows of such a robot, which must outlive what they open. Throws ModelError if a hand
// does not fit into its messages.
std::vector<StateRow> StateRows(const robot::RobotSpec& spec);

// Returns the topics of all rows, in the order of Port::topics().
std::vector<StateTopic> StateTopics(const robot::RobotSpec& spec);

}  // namespace understudy::wire
