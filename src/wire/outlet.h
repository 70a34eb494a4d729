// One topic on which a robot publishes: its writer, rate, readers and link.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bus/participant.h"
#include "bus/topic.h"
#include "bus/writer.h"
#include "robot/fault.h"
#include "robot/rate.h"
#include "wire/link.h"
#include "wire/robot_topics.h"

namespace understudy::wire {

// What the outlets of a robot have in common.
struct OutletTick {
  double t = 0;                                  // s, simulated
  std::span<const robot::LinkEffects> faults{};  // by outlet; empty: none
  bool any_late = false;                         // of any outlet
  std::uint64_t failures = 0;                    // messages that Cyclone refused
};

// The part of Outlet that does not depend on the message.
class OutletCore {
 public:
  // `topic` has a rate for Due(), or 0. `tick` must outlive this; `number` is its place there.
  OutletCore(RobotTopic topic, double timestep, std::size_t number, OutletTick* tick, bool has_crc)
      : topic_(std::move(topic)),
        rate_(topic_.hz > 0 ? topic_.hz : 1, timestep),
        number_(number),
        tick_(tick),
        link_(has_crc) {}
  virtual ~OutletCore() = default;

  const RobotTopic& topic() const { return topic_; }
  bool Due(std::int64_t step) const { return rate_.Due(step); }
  virtual int readers() const = 0;  // matched now

  // Sends the late messages that have arrived.
  void SendLate() {
    while (const std::vector<char>* const packed = link_.Arrived(tick_->t)) {
      if (!WritePacked(*packed)) ++tick_->failures;
    }
    tick_->any_late |= link_.any_late();
  }
  // Drops all that is under way.
  void Clear() { link_.Clear(); }

 protected:
  robot::LinkEffects faults() const {
    return tick_->faults.empty() ? robot::LinkEffects{} : tick_->faults[number_];
  }
  virtual bool WritePacked(const std::vector<char>& packed) = 0;

  RobotTopic topic_;
  robot::Rate rate_;
  std::size_t number_;
  OutletTick* tick_;
  Link<std::vector<char>> link_;
};

// Sends messages of one type over a link that can be faulty. It does not matter what they are made
// of. Those that are under way are kept as bytes, with all that they point to.
template <typename Msg>
class Outlet final : public OutletCore {
 public:
  // Throws BusError if Cyclone refuses, or if Msg is not the type of the descriptor.
  Outlet(const bus::Participant& participant, const dds_topic_descriptor& type, RobotTopic topic,
         double timestep, std::size_t number, OutletTick* tick)
      : OutletCore(std::move(topic), timestep, number, tick, kHasCrc),
        writer_(participant, bus::Topic<Msg>{topic_.name.c_str(), &type}) {}

  bool has_readers() const { return writer_.has_readers(); }
  int readers() const override { return writer_.matched_readers(); }
  const bus::Writer<Msg>& writer() const { return writer_; }
  // Returns whether nothing of what is sent now arrives.
  bool drops() const { return faults().drops; }

  // Sends the message now; it is unchanged afterwards. Returns false if Cyclone refuses it. Never
  // blocks; while nothing is wrong with the link only Cyclone allocates.
  bool Send(Msg* message) {
    const robot::LinkEffects faults = OutletCore::faults();
    if (link_.IsClear(faults)) {
      const bool written = writer_.Write(*message);
      if (!written) ++tick_->failures;
      return written;
    }
    const std::uint64_t before = tick_->failures;
    link_.Send(faults, tick_->t, [&](std::vector<char>* packed, bool damaged) {
      Damage(damaged, message);
      writer_.Pack(*message, packed);
      Damage(damaged, message);
    });
    SendLate();
    return tick_->failures == before;
  }

 private:
  static constexpr bool kHasCrc = requires(Msg message) { message.crc; };

  // Makes a right crc wrong, and that one right again.
  static void Damage(bool damaged, Msg* message) {
    if constexpr (kHasCrc) message->crc ^= damaged ? 1U : 0U;
  }
  bool WritePacked(const std::vector<char>& packed) override { return writer_.WritePacked(packed); }

  bus::Writer<Msg> writer_;
};

}  // namespace understudy::wire
