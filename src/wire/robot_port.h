// The robot as seen from outside: commands come in, states go out.
#pragma once

#include <cstddef>
#include <cstdint>

#include "robot/port_counts.h"
#include "robot/refusal.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// The real one is Port; tests have a fake one. Polled by the tick; nothing here blocks, throws or,
// after the first few calls, allocates.
class RobotPort {
 public:
  virtual ~RobotPort() = default;

  // Takes one waiting command of a topic (robot/command_topics.h), oldest first. False when none
  // waits, as always where the robot has no such topic. On true `command` holds it, sized to the
  // motors and in their order, and `form` what is wrong with its form; kNone when nothing is.
  // Fields whose form is wrong hold what could be read, so that a lenient robot can go on with
  // them; one that IsUnreadable leaves `command` as it was.
  virtual bool Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) = 0;

  // Whether a message is due in that step: if so Publish wants the state.
  virtual bool Due(std::int64_t step) const = 0;
  // Sends what is due in that step. `joint_space` of the state says in which space parallel joints
  // are reported.
  virtual void Publish(const robot::RobotState& state, std::int64_t step) = 0;

  // How many writers of rt/lowcmd are matched now.
  virtual int command_writers() const = 0;

  virtual robot::PortCounts counts() const = 0;
};

}  // namespace understudy::wire
