// Keeps simulated time beside wall time.
#pragma once

#include <cstdint>

#include "time/clock.h"
#include "time/histogram.h"
#include "time/pace.h"

namespace understudy::time {

// What a run may know of its own punctuality.
struct PaceReading {
  std::uint64_t overruns = 0;  // ticks that began more than one period late
  double lateness = 0;         // s, of the last tick; 0 when on time
  double worst_lateness = 0;   // s, since start
  Histogram latenesses{};      // of all ticks since start
  std::uint64_t shifts = 0;    // ticks later than kMostMadeUp, from which the deadlines count anew
  double shifted = 0;          // s, by which those have moved the deadlines in all
  double real_time_factor =
      0;  // simulated / wall time over the last second; 0 until one has passed
};

// Wall time of lateness that is made up for. Assumed: the default of gate.timeout, so that at real
// time the burst that makes up for a stall cannot outlast a program's last command.
inline constexpr Clock::Time kMostMadeUp = std::chrono::milliseconds(200);

// Every deadline is absolute: start + step · period / speed. A late tick is therefore made up for
// by the next ones; how late each began is measured and counted. No step is ever left out. After a
// stall of more than kMostMadeUp (a debugger, a stopped process, a machine too slow for the speed)
// the deadlines move by the whole of it and the late step counts as due: simulated time stays
// behind, and nothing races after it. With speed 0 the pacer never waits.
class Pacer {
 public:
  // period: simulated time of one step. speed: simulated seconds per wall second, 0 for as fast as
  // possible. `clock` must outlive the pacer. The deadlines count from this moment.
  Pacer(Clock* clock, Clock::Time period, double speed);

  // Waits for the deadline of step `step` (0 is due at once) and notes how late it was reached. A
  // signal may end the wait early; that counts as on time. False when the deadline is further away
  // than `most`, after so long: nothing is noted.
  bool WaitFor(std::int64_t step, Clock::Time most = Clock::Time::max());

  // The same as `pace` has it: at its speed, and never while it stands still. When the pace changes
  // `step` is due at once.
  bool Follow(const Pace& pace, std::int64_t step, Clock::Time most);

  // Counts from now on, so that `step` is due at once: after a pause, or a new speed.
  void Resume(std::int64_t step, double speed);

  const PaceReading& reading() const { return reading_; }
  // When the last wait for a step that was due ended.
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
