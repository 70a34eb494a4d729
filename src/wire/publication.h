// A publication: a periodic message, its topics with their rates, and how it is made.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/late_queue.h"
#include "bus/participant.h"
#include "bus/writer.h"
#include "robot/fault.h"
#include "robot/rate.h"
#include "robot/robot_values.h"

namespace understudy::wire {

struct StateTopic {
  std::string name;
  const dds_topic_descriptor* type;
  double hz;  // of simulated time
};

class Publication {
 public:
  virtual ~Publication() = default;

  // Returns whether one of its topics is due in that step.
  virtual bool Due(std::int64_t step) const = 0;
  // Sends the message on the topics that are due in that step and have readers. Never blocks or
  // throws, and does not allocate after the first few calls. Returns how many messages Cyclone has
  // refused. `links` has the faults of its topics, in their order; none: empty.
  virtual std::uint64_t Publish(const robot::RobotState& state, std::int64_t step,
                                std::span<const robot::LinkEffects> links) = 0;
  virtual const std::vector<std::string>& topics() const = 0;
};

// Sends one message on topics of different rates, made once for all topics that are due in a step
// by bool encode(const robot::RobotState&, Msg*), which returns false if there is nothing to send.
// `encode` gets the same message each time, all zero before the first.
template <typename Msg, typename Encode>
class MessagePublication final : public Publication {
 public:
  // `topics` have Msg for their type. Throws BusError if Cyclone refuses.
  MessagePublication(const bus::Participant& participant, double timestep,
                     std::span<const StateTopic> topics, Encode encode)
      : encode_(std::move(encode)) {
    for (const StateTopic& topic : topics) {
      outlets_.push_back({bus::Writer(participant, bus::Topic<Msg>{topic.name.c_str(), topic.type}),
                          robot::Rate(topic.hz, timestep)});
      topics_.push_back(topic.name);
    }
    timestep_ = timestep;
  }

  bool Due(std::int64_t step) const override {
    return any_late_ ||
           std::ranges::any_of(outlets_, [step](const Outlet& o) { return o.rate.Due(step); });
  }

  std::uint64_t Publish(const robot::RobotState& state, std::int64_t step,
                        std::span<const robot::LinkEffects> links) override {
    bool made = false;
    std::uint64_t failures = any_late_ ? PublishLate(step) : 0;
    for (std::size_t i = 0; i < outlets_.size(); ++i) {
      Outlet& outlet = outlets_[i];
      const robot::LinkEffects link = links.empty() ? robot::LinkEffects{} : links[i];
      if (!outlet.rate.Due(step) || !outlet.writer.has_readers() || link.drops) continue;
      if (link.delay > 0 || !outlet.late.empty()) {
        Late* const late = outlet.late.Push(static_cast<double>(step) * timestep_ + link.delay);
        if (late != nullptr) *late = {state, link};
        any_late_ = true;
        continue;
      }
      if (!made && !encode_(state, &message_)) break;
      made = true;
      failures += Send(&outlet, link);
    }
    return failures;
  }

  const std::vector<std::string>& topics() const override { return topics_; }

 private:
  static constexpr bool kHasCrc = requires(Msg message) { message.crc; };

  // The message is made of its state when it goes: it may point to what is made with it.
  struct Late {
    robot::RobotState state;
    robot::LinkEffects link;
  };

  struct Outlet {
    bus::Writer<Msg> writer;
    robot::Rate rate;
    std::optional<Msg> held{};  // goes after the next one; what it points to is as new as that
    LateQueue<Late> late{};
  };

  // Sends the messages that were late and are due in that step.
  std::uint64_t PublishLate(std::int64_t step) {
    const double now = static_cast<double>(step) * timestep_;
    std::uint64_t failures = 0;
    any_late_ = false;
    for (Outlet& outlet : outlets_) {
      while (const Late* late = outlet.late.Due(now)) {
        if (encode_(late->state, &message_)) failures += Send(&outlet, late->link);
        outlet.late.Pop();
      }
      any_late_ = any_late_ || !outlet.late.empty();
    }
    return failures;
  }

  // Sends message_ as the faults of its topic have it.
  std::uint64_t Send(Outlet* outlet, const robot::LinkEffects& link) {
    if (link.damages && !kHasCrc) return 0;
    if (link.reorders && !outlet->held) {
      outlet->held = message_;
      return 0;
    }
    std::uint64_t failures = 0;
    for (int times = link.doubles ? 2 : 1; times > 0; --times) {
      failures += Write(outlet, &message_, link.damages);
    }
    if (outlet->held) failures += Write(outlet, &*outlet->held, false);
    outlet->held.reset();
    return failures;
  }

  // Returns how many failed: 0 or 1. `damaged`: with a wrong crc.
  static std::uint64_t Write(Outlet* outlet, Msg* message, bool damaged) {
    const auto flip = [&] {
      if constexpr (kHasCrc) message->crc ^= damaged ? 1U : 0U;
    };
    flip();
    const bool written = outlet->writer.Write(*message);
    flip();
    return written ? 0 : 1;
  }

  std::vector<Outlet> outlets_;
  std::vector<std::string> topics_;  // of outlets_
  Encode encode_;
  Msg message_{};
  double timestep_ = 0;  // s
  bool any_late_ = false;
};

}  // namespace understudy::wire
