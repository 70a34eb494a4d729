// The interface between a robot and the bus: commands in, states out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "robot/fault.h"
#include "robot/lidar_reading.h"
#include "robot/port_counts.h"
#include "robot/refusal.h"
#include "robot/robot_values.h"
#include "wire/robot_topics.h"

namespace understudy::wire {

// The faults of a robot's links in a tick; empty: none.
struct LinkFaults {
  std::span<const robot::LinkEffects> commands{};  // by number (robot/command_topics.h)
  // In the order of RobotPort::topics() and then services::ServicePort::topics().
  std::span<const robot::LinkEffects> publications{};
};

// Polled by the tick. No function blocks or throws, or allocates after the first few calls. Port
// implements it; tests have a fake.
class RobotPort {
 public:
  virtual ~RobotPort() = default;

  // Begins the tick at t [s], which never goes back. `faults` hold until the next one and must be
  // valid until then.
  virtual void BeginTick(double t, const LinkFaults& faults) = 0;

  // Takes the next command of a topic (robot/command_topics.h) that has arrived over its link.
  // Returns false if none has or the robot does not have the topic. On true, `command` has it in
  // motor order and `form` its fault of form, or kNone. A command with a fault of form is decoded
  // as far as possible for a lenient intake; one that IsUnreadable leaves `command` unchanged.
  virtual bool Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) = 0;

  // Returns how many commands of a topic were lost since the last call: more came than were taken,
  // so that newer ones replaced them, too many were late, or the bus reported them lost.
  virtual std::uint64_t TakeLost(std::size_t topic) = 0;
  // Returns how many commands of a topic arrived so far.
  virtual std::uint64_t heard(std::size_t topic) const = 0;
  // Keeps the newest commands while simulated time stands still; those that they replace do not
  // count as lost.
  virtual void KeepNewest() = 0;
  // Drops all that waits or is under way, commands and messages; none of it counts as lost.
  virtual void Clear() = 0;

  // Returns whether a message is due in that step, so that Publish needs the state.
  virtual bool Due(std::int64_t step) const = 0;
  // Sends the messages that are due in that step. `joint_space` of the state is the space in which
  // parallel pairs are reported.
  virtual void Publish(const robot::RobotState& state, std::int64_t step) = 0;
  // Returns whether one of them has what the pads of hands show, and is read.
  virtual bool ReadsTouch(std::int64_t step) const = 0;
  // Returns whether somebody reads that content of the lidar, so that it must be made.
  virtual bool ReadsLidar(Content content) const = 0;
  virtual void PublishLidar(Content content, const robot::LidarReading& reading) = 0;
  // Returns the topics of states and lidar.
  virtual std::vector<std::string> topics() const = 0;

  // Returns how many writers of rt/lowcmd are matched now.
  virtual int command_writers() const = 0;

  virtual robot::PortCounts counts() const = 0;
  virtual robot::PortNews TakeNews() = 0;
};

}  // namespace understudy::wire
