// The topics of a robot on the bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bus/participant.h"
#include "robot/command_topics.h"
#include "robot/rate.h"
#include "robot/robot_spec.h"
#include "wire/command_source.h"
#include "wire/inlet.h"
#include "wire/lidar_outlets.h"
#include "wire/outlets.h"
#include "wire/publication.h"
#include "wire/robot_port.h"
#include "wire/robot_topics.h"
#include "wire/slots.h"

namespace understudy::wire {

// Reads a robot's commands and publishes its states. Topics and rates are those of robot_topics.h;
// go_port.cc and hg_port.cc have how messages are decoded and made.
class Port final : public RobotPort {
 public:
  // `participant` and `spec` must outlive the port; `timestep` [s] is that of the physics. Throws
  // BusError if Cyclone refuses and ModelError if the robot does not fit into the messages.
  Port(const bus::Participant& participant, const robot::RobotSpec& spec, double timestep);
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  void BeginTick(double t, const LinkFaults& faults) override;
  bool Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) override;
  std::uint64_t TakeLost(std::size_t topic) override;
  std::uint64_t heard(std::size_t topic) const override { return sources_[topic].inlet.heard(); }
  void KeepNewest() override;
  void Clear() override;
  bool Due(std::int64_t step) const override;
  void Publish(const robot::RobotState& state, std::int64_t step) override;
  bool ReadsTouch(std::int64_t step) const override;
  bool ReadsLidar(Content content) const override { return lidar_->Reads(content); }
  void PublishLidar(Content content, const robot::LidarReading& reading) override {
    lidar_->Publish(content, reading);
  }
  std::vector<std::string> topics() const override;
  int command_writers() const override;
  robot::PortCounts counts() const override;
  robot::PortNews TakeNews() override;

  // All that the robot publishes: its states, and what others open here.
  Outlets& outlets() { return outlets_; }

  // Returns the readers of the command topics, which live as long as the port.
  std::vector<const bus::ReaderCore*> readers() const;

 private:
  struct Source {
    std::unique_ptr<CommandSource> commands;  // null: the robot does not have the topic
    Inlet inlet;
  };

  // Add the readers of commands. Throw ModelError if the robot does not fit into the messages.
  void HearGo();
  void HearHg();
  // Of what a command of rt/lowcmd has beyond its motors.
  void NoteUnusedSlots(const UnusedSlots& slots);
  void NoteUnsetHead();

  // Open the outlets of a message. Throw ModelError if a hand does not fit into it.
  std::unique_ptr<Publication> OpenGo(const StateMessage& message);
  std::unique_ptr<Publication> OpenHg(const StateMessage& message);
  std::unique_ptr<Publication> OpenHand(const StateMessage& message);
  std::size_t FirstCell(std::size_t hand) const;  // of a hand in RobotState::touch
  std::unique_ptr<Publication> OpenTouch(const StateMessage& message);
  void HearHand(std::size_t hand, const std::string& topic);
  // Of a message that both families have with the same type.
  std::unique_ptr<Publication> OpenShared(const StateMessage& message);

  template <typename Msg, typename Encode>
  std::unique_ptr<Publication> Open(const StateMessage& message, Encode encode) {
    return std::make_unique<MessagePublication<Msg, Encode>>(&outlets_, message.topics,
                                                             std::move(encode));
  }

  template <typename Msg, typename Decode>
  void Hear(std::size_t number, const bus::Topic<Msg>& topic, Decode decode) {
    sources_[number].commands =
        std::make_unique<MessageSource<Msg, Decode>>(participant_, topic, decode);
  }

  const bus::Participant& participant_;
  const robot::RobotSpec& spec_;
  robot::Rate lowstate_;
  std::vector<Source> sources_;  // by number
  Outlets outlets_;
  std::vector<std::unique_ptr<Publication>> publications_;
  std::vector<const Publication*> with_touch_;  // of publications_
  std::optional<LidarOutlets> lidar_;           // behind those of the states
  std::size_t states_ = 0;                      // how many of outlets_ are those of states, lidar
  std::uint64_t told_failures_ = 0;             // of outlets_
  double now_ = 0;                              // s
  std::span<const robot::LinkEffects> faults_;  // of the commands
  robot::PortCounts counts_;
  robot::PortNews news_;
  bool told_of_unused_slots_ = false;
  int writers_ = 0;  // of rt/lowcmd when they were last news
};

}  // namespace understudy::wire
