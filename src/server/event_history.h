// The newest events, for clients that come later.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "emulator/event_table.h"

namespace understudy::server {

struct KnownEvent {
  std::uint64_t number = 0;  // in this history, from 0
  emulator::ToldEvent told;
};

// Of the server's thread.
class EventHistory {
 public:
  static constexpr std::size_t kMost = 256;  // events that are kept; *assumed*

  // Of nothing where there is no ring; else the ring must outlive it.
  explicit EventHistory(const emulator::EventRing* events = nullptr) {
    if (events != nullptr) reader_.emplace(events);
  }

  // Reads what has happened since the last call; `now` is wall time. Of bursts each cause is told
  // at most once a second.
  void Update(std::chrono::nanoseconds now);

  const std::deque<KnownEvent>& newest() const { return newest_; }  // oldest first
  std::uint64_t next() const { return next_; }                      // the number of the next
  // Events of each kind since the start, bursts counted one by one.
  const std::array<std::uint64_t, emulator::kEventKinds>& counts() const { return counts_; }

 private:
  void Add(const emulator::ToldEvent& told);

  std::optional<emulator::EventRing::Reader> reader_;
  emulator::EventDigest digest_{1.0};
  std::deque<KnownEvent> newest_;
  std::uint64_t next_ = 0;
  std::array<std::uint64_t, emulator::kEventKinds> counts_{};
};

// {"number": 3, "step": 20, "time": 0.02, "robot": 0, "kind": "refused", "level": "warning",
// "text": "refused ...", "detail": {...}}; `level` is "" for what is not logged.
nlohmann::ordered_json EventJson(const KnownEvent& event);
// {"events": [...]}, oldest first.
nlohmann::ordered_json EventsJson(const EventHistory& history);

}  // namespace understudy::server
