// Keeps the newest events for clients that connect later.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "emulator/told_event.h"

namespace understudy::server {

struct KnownEvent {
  std::uint64_t number = 0;  // counts the events of this history, from 0
  emulator::ToldEvent told;
};

// For the server's thread.
class EventHistory {
 public:
  static constexpr std::size_t kMost = 256;  // events that are kept; *assumed*

  // Of a robot and its world. `events` must outlive it; null: no events.
  explicit EventHistory(const emulator::EventRing* events = nullptr, std::size_t robot = 0)
      : robot_(robot) {
    if (events != nullptr) reader_.emplace(events);
  }

  // Reads the events since the last call; `now` is wall time of the steady clock. In a burst each
  // cause appears at most once a second.
  void Update(std::chrono::nanoseconds now = std::chrono::steady_clock::now().time_since_epoch());

  const std::deque<KnownEvent>& newest() const { return newest_; }  // oldest first
  std::uint64_t next() const { return next_; }                      // the number of the next event
  // Returns the number of events of each kind since the start, including all of a burst.
  const std::array<std::uint64_t, emulator::kEventKinds>& counts() const { return counts_; }
  // Returns the number of writers that do not match a topic, by who they are and why not, as the
  // events have it. A run reports a bounded number.
  const std::map<std::string, std::uint64_t>& unmatched() const { return unmatched_; }
  // Returns the topics that programs wait for, or write, in vain, as events tell them.
  const std::vector<emulator::Event>& unserved() const { return unserved_; }

 private:
  void Add(const emulator::ToldEvent& told);

  std::size_t robot_;
  std::optional<emulator::EventRing::Reader> reader_;
  emulator::EventDigest digest_{1.0};
  std::deque<KnownEvent> newest_;
  std::uint64_t next_ = 0;
  std::array<std::uint64_t, emulator::kEventKinds> counts_{};
  std::map<std::string, std::uint64_t> unmatched_;
  std::vector<emulator::Event> unserved_;
};

// {"number": 3, "step": 20, "time": 0.02, "robot": 0, "kind": "refused", "level": "warning",
// "text": "refused ...", "detail": {...}}; `level` is "" for events that are not logged.
nlohmann::ordered_json EventJson(const KnownEvent& event);
// The topics of EventHistory::unserved: [{"topic": "rt/utlidar/cloud", "reads": true, "process":
// 12, "text": ...}], in the order in which they were found.
nlohmann::ordered_json UnservedJson(const EventHistory& history);
// {"events": [...]}, oldest first.
nlohmann::ordered_json EventsJson(const EventHistory& history);

}  // namespace understudy::server
