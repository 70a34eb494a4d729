// A robot's port without programs: no command comes, and what it publishes goes nowhere.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "robot/rate.h"
#include "robot/robot_spec.h"
#include "wire/robot_port.h"
#include "wire/robot_topics.h"

namespace understudy::assembly {

// A base for ports that only take commands or only read states.
class NullPort : public wire::RobotPort {
 public:
  // A state is due whenever one of the robot's messages is. Each sample draws its noise, so that it
  // is the one that the robot has on the bus. `timestep` [s] is that of the physics.
  NullPort(const robot::RobotSpec& spec, double timestep) {
    for (const wire::StateMessage& message : wire::StateMessages(spec)) {
      for (const wire::RobotTopic& topic : message.topics) {
        if (topic.hz > 0) rates_.emplace_back(topic.hz, timestep);
      }
    }
  }

  void BeginTick(double, const wire::LinkFaults&) override {}
  bool Take(std::size_t, robot::RobotCommand*, robot::Refusal*) override { return false; }
  std::uint64_t TakeLost(std::size_t) override { return 0; }
  std::uint64_t heard(std::size_t) const override { return 0; }
  void KeepNewest() override {}
  void Clear() override {}
  bool Due(std::int64_t step) const override {
    return std::ranges::any_of(rates_, [step](robot::Rate rate) { return rate.Due(step); });
  }
  void Publish(const robot::RobotState&, std::int64_t) override {}
  bool ReadsTouch(std::int64_t) const override { return false; }
  bool ReadsLidar(wire::Content) const override { return false; }
  void PublishLidar(wire::Content, const robot::LidarReading&) override {}
  std::vector<std::string> topics() const override { return {}; }
  int command_writers() const override { return 0; }
  robot::PortCounts counts() const override { return {}; }
  robot::PortNews TakeNews() override { return {}; }

 private:
  std::vector<robot::Rate> rates_;  // of all messages
};

}  // namespace understudy::assembly
