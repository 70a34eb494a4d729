// The interface between a robot and the bus: commands in, states out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "robot/fault.h"
#include "robot/port_counts.h"
#include "robot/refusal.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Polled by the tick. No function blocks or throws, or allocates after the first few calls. Port
// implements it; tests have a fake.
class RobotPort {
 public:
  virtual ~RobotPort() = default;

  // Takes one waiting command of a topic (robot/command_topics.h), oldest first. Returns false if
  // none waits or the robot does not have the topic. On true, `command` has it in motor order and
  // `form` its fault of form, or kNone. A command with a fault of form is decoded as far as
  // possible for a lenient intake; one that IsUnreadable leaves `command` unchanged.
  virtual bool Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) = 0;

  // Returns how many commands of a topic were lost since the last call: more came than were taken,
  // so that newer ones replaced them, or the bus reported them lost.
  virtual std::uint64_t TakeLost(std::size_t topic) = 0;
  // Keeps the newest commands while simulated time stands still; those that they replace do not
  // count as lost.
  virtual void Rest() = 0;

  // Returns whether a message is due in that step, so that Publish needs the state.
  virtual bool Due(std::int64_t step) const = 0;
  // Sends the messages that are due in that step. `joint_space` of the state is the space in which
  // parallel pairs are reported.
  // `links` has the faults of its topics(), in their order; none: empty.
  virtual void Publish(const robot::RobotState& state, std::int64_t step,
                       std::span<const robot::LinkEffects> links) = 0;
  // Returns the topics of states.
  virtual std::vector<std::string> topics() const = 0;

  // Returns how many writers of rt/lowcmd are matched now.
  virtual int command_writers() const = 0;

  virtual robot::PortCounts counts() const = 0;
  virtual robot::PortNews TakeNews() = 0;
};

}  // namespace understudy::wire
