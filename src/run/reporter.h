// Reports a run: log lines for events, a status line on a terminal.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "emulator/status.h"
#include "emulator/told_event.h"

namespace understudy::run {

// Logs events, in a burst each cause at most once a second; that the machine is too slow, which
// would be each second, at most once a minute. Used by the housekeeping thread.
class Reporter {
 public:
  // `events` must outlive the reporter. `expected_hz` is the number of LowState samples per
  // simulated second; `status_line` redraws a line on standard error. Lines on a robot begin with
  // its name, by its number in `names`; empty: with none.
  Reporter(const emulator::EventRing* events, double expected_hz, bool status_line,
           std::vector<std::string> names = {});
  ~Reporter();  // logs events held back and clears the status line
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  using WallTime = std::chrono::nanoseconds;
  // `now` is wall time and must not go back.
  void Update(const emulator::Status& status, WallTime now);

 private:
  void LogEvents(WallTime now);
  void Log(const emulator::ToldEvent& told) const;
  // Logs it, or keeps it if it is a slow machine's.
  void Say(const emulator::ToldEvent& told, double now);
  void DrawStatusLine(const emulator::Status& status, WallTime now);

  emulator::EventRing::Reader events_;
  emulator::EventDigest digest_{1.0, 10.0};  // s, *assumed*
  emulator::EventDigest slowness_{60.0};     // s, *assumed*
  double expected_hz_;
  std::vector<std::string> names_;
  bool status_line_;
  bool line_drawn_ = false;
  WallTime updated_at_{};
  emulator::Status drawn_;
  WallTime drawn_at_{};
};

}  // namespace understudy::run
