// A port for a robot that a program in this process commands.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "assembly/null_port.h"
#include "robot/command_topics.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::assembly {

// A robot's port: it takes the commands that a program in this process has given since the last
// step, in their order, and keeps the last LowState.
class CommandPort final : public NullPort {
 public:
  CommandPort(const robot::RobotSpec& spec, double timestep)
      : NullPort(spec, timestep), rate_(spec.rates.lowstate_hz, timestep) {}

  void Give(std::size_t topic, robot::RobotCommand command) {
    given_[topic].push_back(std::move(command));
  }

  bool Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) override;
  std::uint64_t heard(std::size_t topic) const override { return heard_[topic]; }
  void Clear() override { given_ = {}; }
  // Other messages are due between LowStates.
  void Publish(const robot::RobotState& state, std::int64_t step) override {
    if (rate_.Due(step)) lowstate_ = state;
  }

  // Empty before the first.
  const robot::RobotState& lowstate() const { return lowstate_; }

 private:
  robot::Rate rate_;
  robot::RobotState lowstate_;
  std::array<std::deque<robot::RobotCommand>, robot::kMostCommandTopics> given_;
  std::array<std::uint64_t, robot::kMostCommandTopics> heard_{};
};

}  // namespace understudy::assembly
