// Reads commands to motors from one topic.
#pragma once

#include <cstdint>
#include <utility>

#include "bus/participant.h"
#include "bus/reader.h"
#include "robot/refusal.h"
#include "robot/robot_values.h"

namespace understudy::wire {

class CommandSource {
 public:
  virtual ~CommandSource() = default;

  // See RobotPort::Take.
  virtual bool Take(robot::RobotCommand* command, robot::Refusal* form) = 0;
  virtual int writers() const = 0;  // matched now
};

// Decodes messages with robot::Refusal decode(const Msg&, robot::RobotCommand*), which returns the
// fault of form.
template <typename Msg, typename Decode>
class MessageSource final : public CommandSource {
 public:
  // Throws BusError if Cyclone refuses.
  MessageSource(const bus::Participant& participant, const bus::Topic<Msg>& topic, Decode decode)
      : reader_(participant, topic), decode_(std::move(decode)) {}

  bool Take(robot::RobotCommand* command, robot::Refusal* form) override {
    const auto visit = [&](const Msg& message, bus::WriterHandle) {
      *form = decode_(message, command);
    };
    if (reader_.Take(visit, 1) == 1) return true;
    if (undecoded_ == reader_.undecoded()) return false;
    ++undecoded_;
    *form = robot::Refusal::kUndecoded;
    return true;
  }

  int writers() const override { return reader_.matched_writers(); }

 private:
  bus::Reader<Msg> reader_;
  Decode decode_;
  std::uint64_t undecoded_ = reader_.undecoded();  // reported so far
};

}  // namespace understudy::wire
