// Says what a run is doing: log lines for what changed, a status line on a terminal.
#ifndef UNDERSTUDY_RUN_REPORTER_H_
#define UNDERSTUDY_RUN_REPORTER_H_

#include <array>
#include <chrono>
#include <cstdint>
#include <string>

#include "emulator/status.h"

namespace understudy::run {

// Compares each status with the one before and logs what is new, every cause at most once a second.
// Lives in the housekeeping thread, never in the tick.
class Reporter {
 public:
  // `expected_hz`: LowState samples per simulated second. `status_line`: redraw a line on standard
  // error.
  Reporter(double expected_hz, bool status_line);
  ~Reporter();  // clears the status line
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  using WallTime = std::chrono::nanoseconds;
  // `now` only has to grow.
  void Update(const emulator::Status& status, WallTime now);

 private:
  // True at most once a second for each cause.
  bool MaySpeak(std::size_t cause, WallTime now);
  void SpeakOfPace(const emulator::Status& status) const;
  void SpeakOfRefusals(std::size_t topic, const emulator::Status& status, WallTime now);
  void SpeakOfHand(std::size_t hand, const emulator::Status& status, WallTime now);
  void DrawStatusLine(const emulator::Status& status, WallTime now);

  double expected_hz_;
  bool status_line_;
  bool line_drawn_ = false;
  emulator::Status last_;
  // Refusals of each topic; time-outs of the hands, and others.
  static constexpr std::size_t kCauses =
      robot::kMostCommandTopics * robot::kRefusals + robot::kMostHands + 9;
  std::array<WallTime, kCauses> spoken_;
  std::array<std::array<std::uint64_t, robot::kRefusals>, robot::kMostCommandTopics>
      said_refused_{};
  std::uint64_t said_overruns_ = 0;
  double said_shifted_ = 0;
  emulator::Status drawn_;
  WallTime drawn_at_{};
};

}  // namespace understudy::run

#endif  // UNDERSTUDY_RUN_REPORTER_H_
