// The topics of a robot on the bus.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "bus/participant.h"
#include "robot/command_topics.h"
#include "robot/rate.h"
#include "robot/robot_spec.h"
#include "wire/command_source.h"
#include "wire/publication.h"
#include "wire/robot_port.h"
#include "wire/slots.h"

namespace understudy::wire {

// Reads a robot's commands and publishes its states. Both lists of topics are made once, by
// spec.family, in go_port.cc and hg_port.cc.
class Port final : public RobotPort {
 public:
  // `participant` and `spec` must outlive the port; `timestep` [s] is that of the physics. Throws
  // BusError if Cyclone refuses and ModelError if the robot does not fit into the messages.
  Port(const bus::Participant& participant, const robot::RobotSpec& spec, double timestep);
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  bool Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) override;
  std::uint64_t TakeLost(std::size_t topic) override;
  void Rest() override;
  bool Due(std::int64_t step) const override;
  void Publish(const robot::RobotState& state, std::int64_t step,
               std::span<const robot::LinkEffects> links) override;
  std::vector<std::string> topics() const override;
  int command_writers() const override;
  robot::PortCounts counts() const override { return counts_; }
  robot::PortNews TakeNews() override;

  // Returns the readers of the command topics, which live as long as the port.
  std::vector<const bus::ReaderCore*> readers() const;

 private:
  // Add the readers of commands. Throw ModelError if the robot does not fit into the messages.
  void HearGo();
  void HearHg();
  // Of what a command of rt/lowcmd has beyond its motors.
  void NoteUnusedSlots(const UnusedSlots& slots);
  void NoteUnsetHead();

  template <typename Msg, typename Decode>
  void Hear(std::size_t number, const bus::Topic<Msg>& topic, Decode decode) {
    sources_[number] = std::make_unique<MessageSource<Msg, Decode>>(participant_, topic, decode);
  }

  const bus::Participant& participant_;
  const robot::RobotSpec& spec_;
  robot::Rate lowstate_;
  std::array<std::unique_ptr<CommandSource>, robot::kMostCommandTopics> sources_;  // null: none
  std::vector<std::unique_ptr<Publication>> publications_;
  robot::PortCounts counts_;
  robot::PortNews news_;
  bool told_of_unused_slots_ = false;
  int writers_ = 0;  // of rt/lowcmd when they were last news
};

}  // namespace understudy::wire
