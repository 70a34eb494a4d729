// The name, fields and text of each kind of event, and how bursts of events are condensed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "emulator/events.h"

namespace understudy::emulator {

enum class EventLevel : std::uint8_t { kSilent, kInfo, kWarning, kError };  // silent: not logged

constexpr std::string_view Name(EventLevel level) {
  constexpr std::array<std::string_view, 4> kNames = {"", "info", "warning", "error"};
  return kNames[static_cast<std::size_t>(level)];
}

// How a field is stored in an event and written as JSON. Each field takes the next of
// Event::numbers, except kText, which is Event::text.
enum class EventFieldType : std::uint8_t {
  kNumber,
  kInteger,
  kBool,
  kText,
  kReason,      // a robot::Refusal
  kCallReason,  // a services::CallRefusal
  kCause,       // a whole number; events with different ones have different causes
  kGate,        // an authority::GateState
  kFault,       // a place in robot::FaultKinds()
  kDanger,      // a place in motion::Dangers()
  kProtects,    // a robot::Protection
  kWish,        // an authority::Unheeded::Reason
  kKeys,        // of the remote controller, as bits
  kWorst,       // a number; a burst has the largest
  kSum,         // a number; a burst has the sum
};

struct EventField {
  std::string_view name{};  // "" ends the fields
  EventFieldType type = EventFieldType::kNumber;
};

struct EventRow {
  EventKind kind;
  std::string_view name;  // in recordings and the control plane
  EventLevel level;
  bool bursts;  // frequent: readers report each cause once per period
  std::array<EventField, 5> fields;
  std::string (*say)(const Event& event, std::uint64_t count);  // for people, without a full stop
  std::string_view when;                                        // it happens
};

std::span<const EventRow, kEventKinds> EventTable();
const EventRow& RowOf(EventKind kind);

// Returns the value of a field, by its place in the row: its number; a switch is 0 or 1, a word its
// judge::WordNumber. Allocates nothing.
double FieldNumber(const Event& event, std::size_t field);

// One or more events of one cause. Time and text are those of the last one.
struct ToldEvent {
  Event event;
  std::uint64_t count = 1;

  // The row's name; of a request that request's.
  std::string_view kind() const;
  std::string text() const { return RowOf(event.kind).say(event, count); }
  // The row's fields, or the request's values; a burst's `count` too.
  nlohmann::json detail() const;
  // The row's level, but a warning if so many ticks were late that the machine is too slow.
  EventLevel level() const;
};

// Condenses bursts. The first event of a cause (robot, kind, text and reason) is reported at once,
// those that follow within `period` as one event after it. All other events are reported at once.
class EventDigest {
 public:
  // The most causes that are told apart within a period; *assumed*, far more than a run has.
  static constexpr std::size_t kMostCauses = 256;

  explicit EventDigest(double period) : period_(period) {}  // s, of the clock that `now` is of

  // Returns what is to be reported at once; otherwise keeps it. `now` never decreases.
  std::optional<ToldEvent> Take(const ToldEvent& told, double now);
  std::optional<ToldEvent> Take(const Event& event, double now) {
    return Take(ToldEvent{.event = event}, now);
  }
  // Return the events kept for long enough, and all kept events.
  std::vector<ToldEvent> Due(double now);
  std::vector<ToldEvent> Rest();

 private:
  struct Cause {
    ToldEvent held;  // count 0 if there is none
    double told_at = 0;
  };

  double period_;
  std::vector<Cause> causes_;
};

}  // namespace understudy::emulator
