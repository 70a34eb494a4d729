// Events as reported to people and programs: their values, and bursts condensed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "emulator/event_table.h"

namespace understudy::emulator {

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
  // The most causes that are distinguished within a period; *assumed*, far more than a run has.
  static constexpr std::size_t kMostCauses = 256;
  // Of these, calls by ids that no service has; *assumed*.
  static constexpr std::ptrdiff_t kMostUnknownCalls = 8;

  // In s of the clock that `now` is of. While refusals of one cause go on, those after the first
  // are reported after twice the time each, up to `longest`.
  explicit EventDigest(double period, double longest = 0) : period_(period), longest_(longest) {}

  // Returns what is to be reported at once; otherwise keeps it. `now` never decreases.
  std::optional<ToldEvent> Take(const ToldEvent& told, double now);
  std::optional<ToldEvent> Take(const Event& event, double now) {
    return Take(ToldEvent{.event = event}, now);
  }
  // Return the events kept for long enough, and all kept events.
  std::vector<ToldEvent> Due(double now);
  std::vector<ToldEvent> Flush();

 private:
  struct Cause {
    ToldEvent held;  // count 0 if there is none
    double told_at = 0, wait = 0;
  };

  // What is held, which is then told. `goes_on`: since the last report, too.
  ToldEvent Tell(double now, bool goes_on, Cause* cause) const;

  double period_, longest_;
  std::vector<Cause> causes_;
};

}  // namespace understudy::emulator
