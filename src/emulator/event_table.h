// The name, fields and text of each kind of event.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "emulator/events.h"

namespace understudy::emulator {

enum class EventLevel : std::uint8_t { kSilent, kInfo, kWarning, kError };  // silent: not logged

constexpr std::string_view Name(EventLevel level) {
  constexpr std::array<std::string_view, 4> kNames = {"", "info", "warning", "error"};
  return kNames[static_cast<std::size_t>(level)];
}

// How often readers get events of one cause: each, once per period with a count, or, while
// they go on, after ever longer periods.
enum class EventPace : std::uint8_t { kEach, kPeriod, kEverLess };

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
  EventPace pace;
  std::array<EventField, 5> fields;
  std::string (*say)(const Event& event, std::uint64_t count);  // for people, without a full stop
  std::string_view when;                                        // it happens
  bool of_world = false;                                        // and not of one of its robots
};

std::span<const EventRow, kEventKinds> EventTable();
const EventRow& RowOf(EventKind kind);

}  // namespace understudy::emulator
