// What each kind of event is called, holds and says, and how bursts of events are condensed.
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

// How a field is kept in an event and told in JSON: each takes one of Event::numbers, in order, but
// for kText, which is Event::text.
enum class EventFieldType : std::uint8_t {
  kNumber,
  kInteger,
  kBool,
  kText,
  kReason,  // a robot::Refusal
  kCause,   // a whole number; with another one the event has another cause
  kGate,    // an authority::GateState
  kKeys,    // of the remote controller, as bits
  kWorst,   // a number; of a burst the largest
  kSum,     // a number; of a burst the sum
};

struct EventField {
  std::string_view name{};  // "" where there is no further field
  EventFieldType type = EventFieldType::kNumber;
};

struct EventRow {
  EventKind kind;
  std::string_view name;  // in recordings and the control plane
  EventLevel level;
  bool bursts;  // comes many times for one cause: readers tell each cause once in a while
  std::array<EventField, 3> fields;
  std::string (*say)(const Event& event, std::uint64_t count);  // for people, without a full stop
  std::string_view when;                                        // it happens
};

std::span<const EventRow, kEventKinds> EventTable();
const EventRow& RowOf(EventKind kind);

// Some events of one cause, as one: its time and text are the last one's.
struct ToldEvent {
  Event event;
  std::uint64_t count = 1;

  // The row's name; of a request that request's.
  std::string_view kind() const;
  std::string text() const { return RowOf(event.kind).say(event, count); }
  // The row's fields, or the request's values; a burst's `count` too.
  nlohmann::json detail() const;
  // The row's, but a warning where so many ticks were late that the machine is too slow.
  EventLevel level() const;
};

// Condenses bursts: of one cause (robot, kind, text and reason) the first event is told at once,
// and what follows within `period` as one event after it. All else is told as it comes.
class EventDigest {
 public:
  explicit EventDigest(double period) : period_(period) {}  // s, of the clock that `now` is of

  // `event` if it is to be told at once; else it is held back. `now` never goes back.
  std::optional<ToldEvent> Take(const Event& event, double now);
  // What was held back for long enough; all that was held back.
  std::vector<ToldEvent> Due(double now);
  std::vector<ToldEvent> Rest();

 private:
  struct Cause {
    ToldEvent held;  // of count 0 where nothing is
    double told_at = 0;
  };

  double period_;
  std::vector<Cause> causes_;
};

}  // namespace understudy::emulator
