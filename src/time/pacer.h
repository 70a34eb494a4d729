// Makes each step wait for its wall time.
#pragma once

#include <cstdint>

#include "time/clock.h"
#include "time/histogram.h"
#include "time/pace.h"

namespace understudy::time {

// The measured punctuality of a run.
struct PaceReading {
  std::uint64_t overruns = 0;  // ticks that began more than one period late
  double lateness = 0;         // s, of the last tick; 0 when on time
  double worst_lateness = 0;   // s, since start
  Histogram latenesses{};      // of all ticks since start
  std::uint64_t shifts = 0;    // ticks later than kMostMadeUp, each of which shifted the deadlines
  double shifted = 0;          // s, sum of these shifts
  double real_time_factor =
      0;  // simulated / wall time over the last second; 0 until one has passed
};

// What a wait for a step came to.
struct Wait {
  bool due = false;    // else the deadline is still too far away
  double overrun = 0;  // s that it was reached too late, where that is more than one period
  double shift = 0;    // s by which the deadlines have moved
};

// The most lateness that is caught up. Assumed: the default of gate.timeout, so that at real time
// the burst after a stall cannot last longer than a program's last command is followed.
inline constexpr Clock::Time kMostMadeUp = std::chrono::milliseconds(200);

// Deadlines are absolute: start + step · period / speed, so the steps after a late one catch up. No
// step is skipped. The pacer measures how late each step begins. After a stall of more than
// kMostMadeUp (a debugger, a stopped process, a machine too slow for the speed) all deadlines shift
// by the stall and the late step counts as due: simulated time stays behind instead of catching up.
// At speed 0 the pacer never waits.
class Pacer {
 public:
  // `period` is the simulated time of one step, `speed` simulated seconds per wall second, 0 for as
  // fast as possible. `clock` must outlive the pacer. Deadlines count from construction.
  Pacer(Clock* clock, Clock::Time period, double speed);

  // Waits for the deadline of step `step` (0 is due at once) and returns how late it was reached. A
  // wait that a signal ends early counts as on time. If the deadline is further away than `most`,
  // waits that long and returns a wait that is not due.
  Wait WaitFor(std::int64_t step, Clock::Time most = Clock::Time::max());

  // The same at the speed of `pace`; while `pace` stands still it waits for `most` and is not due.
  // After a change of pace `step` is due at once.
  Wait WaitFor(const Pace& pace, std::int64_t step, Clock::Time most);

  // Waits for `most` while step `step` may not be made; it is due at once afterwards, and not late.
  // Returns a wait that is not due.
  Wait Hold(std::int64_t step, Clock::Time most);

  // Restarts the deadlines at the given speed: `step` is due at once.
  void Resume(std::int64_t step, double speed);

  const PaceReading& reading() const { return reading_; }
  // When the last wait that returned true ended.
  Clock::Time reached() const { return reached_; }
  double speed() const { return speed_; }

 private:
  void Measure(std::int64_t step, Clock::Time now);

  Clock* clock_;
  Clock::Time period_;
  double speed_;
  bool still_ = false;
  Clock::Time start_;
  std::int64_t start_step_ = 0;
  Clock::Time reached_{};
  Clock::Time window_start_;
  std::int64_t window_step_ = 0;
  PaceReading reading_;
};

}  // namespace understudy::time
