#include "emulator/told_event.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "authority/command_gate.h"
#include "authority/unheeded.h"
#include "judge/condition.h"
#include "motion/protection.h"
#include "robot/fault.h"
#include "robot/refusal_text.h"
#include "robot/remote_keys.h"
#include "services/service_port.h"

namespace understudy::emulator {
namespace {

using nlohmann::json;
using enum EventFieldType;

// Late ticks in one burst that are worth a line; *assumed*: a few are made up for unnoticed.
constexpr std::uint64_t kManyOverruns = 50;

// The word of a field, in `room` if it is none of ours; nullopt for a number.
std::optional<std::string_view> WordOf(const Event& event, EventFieldType type, std::size_t number,
                                       robot::RemoteKeyText* room) {
  switch (type) {
    case kText:
      return event.text.data();
    case kCallReason:
      return services::Name(static_cast<services::CallRefusal>(event.numbers[number]));
    case kReason:
      return robot::Name(static_cast<robot::Refusal>(event.numbers[number]));
    case kGate:
      return authority::Name(static_cast<authority::GateState>(event.numbers[number]));
    case kFault:
      return robot::FaultKinds()[static_cast<std::size_t>(event.numbers[number])].name;
    case kDanger:
      return motion::Dangers()[static_cast<std::size_t>(event.numbers[number])].name;
    case kProtects:
      return robot::Name(static_cast<robot::Protection>(event.numbers[number]));
    case kWish:
      return authority::Name(static_cast<authority::Unheeded::Reason>(event.numbers[number]));
    case kKeys:
      return robot::WriteRemoteKeyNames(static_cast<std::uint16_t>(event.numbers[number]), room);
    case kBool:
    case kInteger:
    case kCause:
    case kNumber:
    case kWorst:
    case kSum:
      break;
  }
  return std::nullopt;
}

json Value(const Event& event, EventFieldType type, std::size_t number) {
  robot::RemoteKeyText room{};
  if (const auto word = WordOf(event, type, number, &room)) return std::string(*word);
  if (type == kBool) return event.numbers[number] != 0;
  if (type == kInteger || type == kCause) return static_cast<std::int64_t>(event.numbers[number]);
  return event.numbers[number];
}

// Calls do_one(field, index of its first number) for each field of the row.
template <class DoOne>
void ForEachField(const EventRow& row, DoOne do_one) {
  std::size_t number = 0;
  for (const EventField& field : row.fields) {
    if (field.name.empty()) return;
    do_one(field, number);
    if (field.type != kText) ++number;
  }
}

bool SameCause(const Event& a, const Event& b) {
  if (a.kind != b.kind || a.robot != b.robot || a.text != b.text) return false;
  bool same = true;
  ForEachField(RowOf(a.kind), [&](const EventField& field, std::size_t i) {
    if (field.type == kReason || field.type == kCallReason || field.type == kCause) {
      same = same && a.numbers[i] == b.numbers[i];
    }
  });
  return same;
}

bool IsUnknownCall(const Event& event) {
  return event.kind == EventKind::kCallRefused &&
         event.numbers[0] == static_cast<double>(services::CallRefusal::kUnknownApi);
}

// Adds events to those that are held, of the same cause.
void Add(const ToldEvent& more, ToldEvent* held) {
  Event both = more.event;
  if (held->count > 0) {
    ForEachField(RowOf(both.kind), [&](const EventField& field, std::size_t i) {
      const double before = held->event.numbers[i];
      if (field.type == kWorst) both.numbers[i] = std::max(before, both.numbers[i]);
      if (field.type == kSum) both.numbers[i] += before;
    });
  }
  *held = {.event = both, .count = held->count + more.count};
}

}  // namespace

double FieldNumber(const Event& event, std::size_t field) {
  const EventRow& row = RowOf(event.kind);
  const auto number = static_cast<std::size_t>(
      std::count_if(row.fields.begin(), row.fields.begin() + static_cast<std::ptrdiff_t>(field),
                    [](const EventField& before) { return before.type != kText; }));
  robot::RemoteKeyText room{};
  const auto word = WordOf(event, row.fields[field].type, number, &room);
  return word ? judge::WordNumber(*word) : event.numbers[number];
}

std::string_view ToldEvent::kind() const {
  return event.kind == EventKind::kRequest ? event.request.row->name : RowOf(event.kind).name;
}

json ToldEvent::detail() const {
  if (event.kind == EventKind::kRequest) return ValuesOf(event.request);
  json detail = json::object();
  const EventRow& row = RowOf(event.kind);
  ForEachField(row, [&](const EventField& field, std::size_t number) {
    detail[std::string(field.name)] = Value(event, field.type, number);
  });
  if (row.pace != EventPace::kEach) detail["count"] = count;
  return detail;
}

EventLevel ToldEvent::level() const {
  const bool too_slow = event.kind == EventKind::kOverrun && count > kManyOverruns;
  return too_slow ? EventLevel::kWarning : RowOf(event.kind).level;
}

std::optional<ToldEvent> EventDigest::Take(const ToldEvent& told, double now) {
  const Event& event = told.event;
  if (RowOf(event.kind).pace == EventPace::kEach) return told;
  auto cause = std::ranges::find_if(
      causes_, [&](const Cause& known) { return SameCause(known.held.event, event); });
  // A client may try any number of ids.
  if (cause == causes_.end() && IsUnknownCall(event)) {
    const auto is_one = [](const Cause& known) { return IsUnknownCall(known.held.event); };
    if (std::ranges::count_if(causes_, is_one) >= kMostUnknownCalls) {
      cause = std::ranges::find_if(causes_, is_one);
    }
  }
  if (cause == causes_.end() && causes_.size() >= kMostCauses) {
    std::erase_if(causes_, [&](const Cause& known) {
      return known.held.count == 0 && now >= known.told_at + known.wait;
    });
    // The network is untrusted: causes beyond the bound count as the last one.
    cause = causes_.size() < kMostCauses ? causes_.end() : causes_.end() - 1;
  }
  if (cause == causes_.end()) {
    causes_.push_back({.held = {.event = event, .count = 0}, .told_at = now, .wait = period_});
    return told;
  }
  const bool goes_on = cause->held.count > 0;
  Add(told, &cause->held);
  if (now < cause->told_at + cause->wait) return std::nullopt;
  return Tell(now, goes_on, &*cause);
}

ToldEvent EventDigest::Tell(double now, bool goes_on, Cause* cause) const {
  const bool grows = RowOf(cause->held.event.kind).pace == EventPace::kEverLess;
  cause->wait = grows && goes_on ? std::max(std::min(2 * cause->wait, longest_), period_) : period_;
  cause->told_at = now;
  return {.event = cause->held.event, .count = std::exchange(cause->held.count, 0)};
}

std::vector<ToldEvent> EventDigest::Due(double now) {
  std::vector<ToldEvent> due;
  for (Cause& cause : causes_) {
    if (cause.held.count == 0 || now < cause.told_at + cause.wait) continue;
    due.push_back(Tell(now, true, &cause));
  }
  return due;
}

std::vector<ToldEvent> EventDigest::Flush() { return Due(std::numeric_limits<double>::infinity()); }

}  // namespace understudy::emulator
