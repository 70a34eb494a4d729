// Reads commands to motors from one topic.
#pragma once

#include <cstddef>
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

  // Takes the oldest waiting command, as RobotPort::Take.
  virtual bool Take(robot::RobotCommand* command, robot::Refusal* form) = 0;
  // See RobotPort::TakeLost, KeepNewest and Clear.
  virtual std::uint64_t TakeLost() = 0;
  virtual void KeepNewest() = 0;
  virtual void Clear() = 0;
  virtual int writers() const = 0;  // matched now
  virtual const bus::ReaderCore& reader() const = 0;
};

// The longest command that is decoded, serialized; *assumed*: hg LowCmd_, the longest of the
// vendor's that robots send, has 1 kB, and a HandCmd_ of seven motors 0.3 kB.
inline constexpr std::size_t kMostCommandBytes = 4096;

// Decodes messages with robot::Refusal decode(const Msg&, robot::RobotCommand*), which returns the
// fault of form.
template <typename Msg, typename Decode>
class MessageSource final : public CommandSource {
 public:
  // Throws BusError if Cyclone refuses.
  MessageSource(const bus::Participant& participant, const bus::Topic<Msg>& topic, Decode decode)
      : reader_(participant, topic, {.most_bytes = kMostCommandBytes}),
        decode_(std::move(decode)) {}

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

  std::uint64_t TakeLost() override {
    reader_.Gather();
    return reader_.lost() - std::exchange(lost_, reader_.lost());
  }
  void KeepNewest() override {
    reader_.Gather();
    lost_ = reader_.lost();
  }
  void Clear() override {
    reader_.Drop();
    lost_ = reader_.lost();
    undecoded_ = reader_.undecoded();
  }
  int writers() const override { return reader_.matched_writers(); }
  const bus::ReaderCore& reader() const override { return reader_; }

 private:
  bus::Reader<Msg> reader_;
  Decode decode_;
  std::uint64_t undecoded_ = reader_.undecoded();  // reported so far
  std::uint64_t lost_ = 0;                         // reported so far
};

}  // namespace understudy::wire
