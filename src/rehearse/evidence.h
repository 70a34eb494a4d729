// Turns the messages of a recording into samples of signals.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "judge/margin.h"
#include "record/cdr_field.h"
#include "record/mcap_format.h"
#include "record/truth.h"
#include "rehearse/first_jump.h"
#include "signals/recent_arrivals.h"
#include "signals/signals.h"

namespace understudy::rehearse {

using signals::Origin;
using signals::Signal;

// As signals::Names has it.
std::string WrongField(const std::string& type, const std::string& field);

// Takes messages in the order of the file, while it is written or read, and gives one sample for
// each instant at which there is one. So a run and its recording give the same samples.
class Evidence {
 public:
  // The values of all signals at `at`; NaN for what nobody has said yet.
  using Give = std::function<void(judge::Time at, std::span<const double> values)>;

  // The samples have the values of `signals` in their order; those of other robots than number
  // `robot` are never said. Times count from `start` [ns since 1970].
  Evidence(std::vector<Signal> signals, std::uint64_t start, Give give, std::size_t robot = 0);

  // The value of a signal before anything has been said: no event has happened.
  static double ValueBefore(const Signal& signal);

  // A message with an earlier time than the one before counts as of that one's.
  void Take(const record::McapChannel& channel, std::string_view ros_type,
            const record::McapMessage& message);
  // Gives the last sample.
  void Finish();

  // Why a signal cannot be known from these messages; "" if it can. Call it after Finish.
  std::string WhyUnknown(std::size_t signal) const;

  // An event as it was recorded.
  struct Told {
    judge::Time at = 0;
    record::RecordedEvent event{};
  };
  // All events but those of late ticks.
  const std::vector<Told>& events() const { return events_; }

 private:
  struct Slot {
    Signal signal;
    std::optional<record::CdrField> field;  // kField, once its channel was seen
    std::string wrong;                      // why not
    double word = 0;                        // kPrint
    std::optional<judge::Time> last;        // kGap: last message
    bool arrived = false;                   // kGap: at this instant
    signals::RecentArrivals recent{};       // kRate
    std::optional<FirstJump> jump{};        // kFirstJump
  };

  void TakeTruth(const record::Truth& truth, const record::StringMap& metadata);
  void TakeObject(const record::Truth& truth, const record::StringMap& metadata, std::size_t place);
  void TakeEvent(const record::RecordedEvent& event);
  void TakeJump(const std::string& topic, std::string_view ros_type, record::ByteSpan message,
                std::size_t place);
  void TakeMessage(const std::string& topic, std::string_view ros_type,
                   const record::McapMessage& message);
  void Flush();

  std::vector<Slot> slots_;
  std::map<std::string, std::vector<std::size_t>, std::less<>> by_topic_;  // places in slots_
  std::uint64_t start_;
  Give give_;
  std::size_t robot_;
  std::vector<double> values_;
  std::optional<judge::Time> now_;
  bool pulses_ = false;  // some value is that of this instant only
  bool truth_ = false, told_ = false;
  bool fixed_base_ = false;  // as the truth has it
  std::vector<Told> events_;
};

}  // namespace understudy::rehearse
