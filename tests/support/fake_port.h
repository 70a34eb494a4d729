// A port without a bus.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "robot/command_topics.h"
#include "wire/inlet.h"
#include "wire/robot_port.h"

namespace understudy::test {

// Commands wait in a queue and come over their link; what is published is kept, in order.
class FakePort final : public wire::RobotPort {
 public:
  struct Sample {
    robot::RobotState state;
  };

  // What was wrong with rt/lowstate when a state was last due.
  const robot::LinkEffects& link() const { return link_; }
  // Queues a command with a fault of form.
  void Send(const robot::RobotCommand& command, robot::Refusal form = robot::Refusal::kNone) {
    SendTo(robot::kLowCmdTopic, command, form);
  }
  void SendArms(robot::RobotCommand command, double weight) {
    command.weight = weight;
    SendTo(robot::kArmSdkTopic, command);
  }
  void SendUser(const robot::RobotCommand& command) { SendTo(robot::kUserLowCmdTopic, command); }
  void SendHand(std::size_t hand, const robot::RobotCommand& command,
                robot::Refusal form = robot::Refusal::kNone) {
    SendTo(robot::kFirstHandTopic + hand, command, form);
  }
  // From now on one such command waits at every drain of the port. Taking it allocates nothing.
  void SendEveryTick(const robot::RobotCommand& command) {
    topics_[robot::kLowCmdTopic].steady = command;
  }
  void SendHandsEveryTick(const robot::RobotCommand& command) {
    for (std::size_t i = robot::kFirstHandTopic; i < topics_.size(); ++i) {
      topics_[i].steady = command;
    }
  }
  // The robot is told of that many lost commands.
  void Lose(std::size_t topic, std::uint64_t commands) { topics_[topic].lost = commands; }
  // How often KeepNewest was called.
  int rests() const { return rests_; }
  // Makes a state due in every `steps`-th step.
  void TellEvery(std::int64_t steps) { every_ = steps; }
  // Is told when the next state has been sent.
  void Bring(const robot::PortNews& news) { news_ = news; }
  // From now on only the last sample is kept; publishing one more then allocates nothing.
  void KeepTheLastOnly() { keep_all_ = false; }

  struct Sight {
    wire::Content content;
    robot::LidarReading reading;
  };
  // Reads these contents of the lidar from now on.
  void ReadLidar(std::set<wire::Content> contents) { read_ = std::move(contents); }
  // Nobody reads from now on what the pads of hands show.
  void IgnoreTouch() { reads_touch_ = false; }
  const std::vector<Sight>& sights() const { return sights_; }

  const std::vector<Sample>& samples() const { return samples_; }
  const Sample& last() const { return samples_.back(); }
  // Whether no command waits on rt/lowcmd.
  bool idle() const { return topics_[robot::kLowCmdTopic].waiting.empty(); }

  void BeginTick(double t, const wire::LinkFaults& faults) override {
    now_ = t;
    faults_ = faults;
  }
  bool Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) override;
  std::uint64_t TakeLost(std::size_t topic) override {
    return std::exchange(topics_[topic].lost, 0) + topics_[topic].inlet.TakeLost();
  }
  std::uint64_t heard(std::size_t topic) const override { return topics_[topic].inlet.heard(); }
  void KeepNewest() override { ++rests_; }
  void Clear() override;
  bool Due(std::int64_t step) const override { return step % every_ == 0; }
  void Publish(const robot::RobotState& state, std::int64_t step) override;
  bool ReadsTouch(std::int64_t /*step*/) const override { return reads_touch_; }
  bool ReadsLidar(wire::Content content) const override { return read_.contains(content); }
  void PublishLidar(wire::Content content, const robot::LidarReading& reading) override {
    sights_.push_back({content, reading});
  }
  std::vector<std::string> topics() const override { return {"rt/lowstate"}; }
  int command_writers() const override { return 1; }
  robot::PortCounts counts() const override { return {.lowstates = published_}; }
  robot::PortNews TakeNews() override { return std::exchange(news_, {}); }

 private:
  struct Waiting {
    robot::RobotCommand command;
    robot::Refusal form;
  };

  struct Topic {
    std::deque<Waiting> waiting;
    std::optional<robot::RobotCommand> steady;
    bool steady_taken = false;  // in this drain
    std::uint64_t lost = 0;
    wire::Inlet inlet{true};
  };

  void SendTo(std::size_t topic, const robot::RobotCommand& command,
              robot::Refusal form = robot::Refusal::kNone) {
    topics_[topic].waiting.push_back({command, form});
  }

  std::array<Topic, robot::kMostCommandTopics> topics_;
  double now_ = 0;
  wire::LinkFaults faults_;
  std::int64_t every_ = 2;  // 500 Hz in steps of 1 ms
  robot::LinkEffects link_;
  robot::PortNews news_;
  bool keep_all_ = true;
  bool reads_touch_ = true;
  int rests_ = 0;
  std::uint64_t published_ = 0;
  std::vector<Sample> samples_;
  std::set<wire::Content> read_;
  std::vector<Sight> sights_;
};

}  // namespace understudy::test
