#include "server/event_history.h"

#include <nlohmann/json.hpp>

namespace understudy::server {

using nlohmann::ordered_json;

void EventHistory::Update(std::chrono::nanoseconds now) {
  if (!reader_) return;
  const double seconds = std::chrono::duration<double>(now).count();
  for (emulator::Event event; reader_->Next(&event);) {
    if (event.robot != robot_ && !emulator::RowOf(event.kind).of_world) continue;
    ++counts_[static_cast<std::size_t>(event.kind)];
    if (event.kind == emulator::EventKind::kUnmatched) ++unmatched_[event.text.data()];
    if (event.kind == emulator::EventKind::kUnserved) unserved_.push_back(event);
    if (const auto told = digest_.Take(event, seconds)) Add(*told);
  }
  for (const emulator::ToldEvent& told : digest_.Due(seconds)) Add(told);
}

void EventHistory::Add(const emulator::ToldEvent& told) {
  if (newest_.size() == kMost) newest_.pop_front();
  newest_.push_back({.number = next_++, .told = told});
}

ordered_json EventJson(const KnownEvent& event) {
  const emulator::ToldEvent& told = event.told;
  return {{"number", event.number},  {"step", told.event.step},
          {"time", told.event.time}, {"robot", told.event.robot},
          {"kind", told.kind()},     {"level", emulator::Name(told.level())},
          {"text", told.text()},     {"detail", told.detail()}};
}

ordered_json UnservedJson(const EventHistory& history) {
  ordered_json topics = ordered_json::array();
  for (const emulator::Event& event : history.unserved()) {
    const emulator::ToldEvent told{.event = event, .count = 1};
    topics.push_back({{"topic", event.text.data()},
                      {"reads", event.numbers[0] != 0},
                      {"process", static_cast<int>(event.numbers[1])},
                      {"text", told.text()}});
  }
  return topics;
}

ordered_json EventsJson(const EventHistory& history) {
  ordered_json events = ordered_json::array();
  for (const KnownEvent& event : history.newest()) events.push_back(EventJson(event));
  return {{"events", events}};
}

}  // namespace understudy::server
