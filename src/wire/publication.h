// A periodic message that is made of the state of a robot, and the outlets on which it goes out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "robot/robot_values.h"
#include "wire/outlets.h"

namespace understudy::wire {

class Publication {
 public:
  virtual ~Publication() = default;

  // Returns whether one of its topics is due in that step.
  virtual bool Due(std::int64_t step) const = 0;
  // Returns whether one of those that are due in that step has a reader.
  virtual bool Wanted(std::int64_t step) const = 0;
  // Sends the message on the topics that are due in that step and have readers. Never blocks or
  // throws, and does not allocate after the first few calls.
  virtual void Publish(const robot::RobotState& state, std::int64_t step) = 0;
};

// Sends one message on topics of different rates, made once for all topics that are due in a step
// by bool encode(const robot::RobotState&, Msg*), which returns false if there is nothing to send.
// `encode` gets the same message each time, all zero before the first.
template <typename Msg, typename Encode>
class MessagePublication final : public Publication {
 public:
  // `topics` have Msg for their type. Throws BusError if Cyclone refuses.
  MessagePublication(Outlets* outlets, const std::vector<RobotTopic>& topics, Encode encode)
      : encode_(std::move(encode)) {
    for (const RobotTopic& topic : topics) outlets_.push_back(outlets->Open<Msg>(topic));
  }

  bool Due(std::int64_t step) const override {
    return std::ranges::any_of(outlets_, [step](const auto* one) { return one->Due(step); });
  }

  bool Wanted(std::int64_t step) const override {
    return std::ranges::any_of(
        outlets_, [step](const auto* one) { return one->Due(step) && one->has_readers(); });
  }

  void Publish(const robot::RobotState& state, std::int64_t step) override {
    bool made = false;
    for (Outlet<Msg>* const outlet : outlets_) {
      if (!outlet->Due(step) || !outlet->has_readers() || outlet->drops()) continue;
      if (!made && !encode_(state, &message_)) break;
      made = true;
      outlet->Send(&message_);
    }
  }

 private:
  std::vector<Outlet<Msg>*> outlets_;
  Encode encode_;
  Msg message_{};
};

}  // namespace understudy::wire
