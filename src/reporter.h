// Says what a run is doing: log lines for what changed, a status line on a terminal.
#ifndef UNDERSTUDY_REPORTER_H_
#define UNDERSTUDY_REPORTER_H_

#include <array>
#include <chrono>
#include <cstdint>
#include <string>

#include "control/status.h"

namespace understudy {

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
  void Update(const Status& status, WallTime now);

 private:
  // True at most once a second for each cause.
  bool MaySpeak(std::size_t cause, WallTime now);
  void SpeakOfPace(const Status& status) const;
  void SpeakOfHand(std::size_t hand, const Status& status, WallTime now);
  void DrawStatusLine(const Status& status, WallTime now);

  double expected_hz_;
  bool status_line_;
  bool line_drawn_ = false;
  Status last_;
  static constexpr std::size_t kHandCauses = kRefusals + 1;  // the refusals and the time-out
  static constexpr std::size_t kCauses = kRefusals + 9 + kMostHands * kHandCauses;
  std::array<WallTime, kCauses> spoken_;
  std::array<std::uint64_t, kRefusals> said_refused_{};
  std::array<std::array<std::uint64_t, kRefusals>, kMostHands> said_hand_refused_{};
  std::uint64_t said_overruns_ = 0;
  double said_shifted_ = 0;
  Status drawn_;
  WallTime drawn_at_{};
};

}  // namespace understudy

#endif  // UNDERSTUDY_REPORTER_H_
