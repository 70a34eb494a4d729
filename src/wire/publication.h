// A message that a robot sends by itself: its topics, when each is due, and how it is made.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "bus/participant.h"
#include "bus/writer.h"
#include "robot/rate.h"
#include "robot/robot_values.h"

namespace understudy::wire {

class Publication {
 public:
  virtual ~Publication() = default;

  // Whether one of its topics is due in that step.
  virtual bool Due(std::int64_t step) const = 0;
  // Sends what is due in that step and has readers. Neither blocks nor throws, nor allocates after
  // the first few calls.
  virtual void Publish(const robot::RobotState& state, std::int64_t step) = 0;
  // Messages that the bus did not take, since start.
  virtual std::uint64_t failures() const = 0;
};

// A row of topics: a topic and how often a second [1/s of simulated time] it is due.
template <typename Msg>
struct TopicRow {
  bus::Topic<Msg> topic;
  double hz;
};
template <typename Msg>
TopicRow(bus::Topic<Msg>, double)
    -> TopicRow<Msg>;  // Clang deduces none for an aggregate before 17

// Sends one message on topics of different rates, made once for all that are due in a step, by
// bool encode(const robot::RobotState&, Msg*): false when there is nothing to tell. It is given the
// same message each time, all zero before the first.
template <typename Msg, typename Encode>
class MessagePublication final : public Publication {
 public:
  // Throws BusError when Cyclone refuses.
  MessagePublication(const bus::Participant& participant, double timestep,
                     std::initializer_list<TopicRow<Msg>> rows, Encode encode)
      : encode_(std::move(encode)) {
    for (const TopicRow<Msg>& row : rows) {
      outlets_.push_back({bus::Writer(participant, row.topic), robot::Rate(row.hz, timestep)});
    }
  }

  bool Due(std::int64_t step) const override {
    return std::ranges::any_of(outlets_, [step](const Outlet& o) { return o.rate.Due(step); });
  }

  void Publish(const robot::RobotState& state, std::int64_t step) override {
    bool made = false;
    for (Outlet& outlet : outlets_) {
      if (!outlet.rate.Due(step) || !outlet.writer.has_readers()) continue;
      if (!made && !encode_(state, &message_)) return;
      made = true;
      outlet.writer.Write(message_);
    }
  }

  std::uint64_t failures() const override {
    std::uint64_t failures = 0;
    for (const Outlet& outlet : outlets_) failures += outlet.writer.failures();
    return failures;
  }

 private:
  struct Outlet {
    bus::Writer<Msg> writer;
    robot::Rate rate;
  };

  std::vector<Outlet> outlets_;
  Encode encode_;
  Msg message_{};
};

}  // namespace understudy::wire
