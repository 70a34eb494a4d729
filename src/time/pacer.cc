#include "time/pacer.h"

#include <algorithm>
#include <cmath>

namespace understudy::time {
namespace {

double Seconds(Clock::Time t) { return std::chrono::duration<double>(t).count(); }

}  // namespace

Pacer::Pacer(Clock* clock, Clock::Time period, double speed)
    : clock_(clock), period_(period), speed_(speed), start_(clock->Now()), window_start_(start_) {}

Wait Pacer::WaitFor(std::int64_t step, Clock::Time most) {
  Wait wait{.due = true};
  Clock::Time now = clock_->Now();
  if (speed_ > 0) {
    const double wall = static_cast<double>((step - start_step_) * period_.count()) / speed_;
    const Clock::Time deadline = start_ + Clock::Time(std::llround(wall));
    if (deadline - now > most) {
      clock_->SleepUntil(now + most);
      return {};
    }
    if (now < deadline) {
      clock_->SleepUntil(deadline);
      now = clock_->Now();
    }
    const Clock::Time late = std::max(Clock::Time(0), now - deadline);
    reading_.lateness = Seconds(late);
    reading_.latenesses.Add(reading_.lateness);
    reading_.worst_lateness = std::max(reading_.worst_lateness, reading_.lateness);
    if (reading_.lateness > Seconds(period_) / speed_) {
      ++reading_.overruns;
      wait.overrun = reading_.lateness;
    }
    if (late > kMostMadeUp) {
      start_ += late;
      ++reading_.shifts;
      wait.shift = reading_.lateness;
      reading_.shifted += wait.shift;
    }
  }
  reached_ = now;
  Measure(step, now);
  return wait;
}

Wait Pacer::WaitFor(const Pace& pace, std::int64_t step, Clock::Time most) {
  if (pace.stands_still()) {
    still_ = true;
    reading_.lateness = 0;
    reading_.real_time_factor = 0;
    clock_->SleepUntil(clock_->Now() + most);
    return {};
  }
  if (still_ || pace.speed != speed_) Resume(step, pace.speed);
  return WaitFor(step, most);
}

Wait Pacer::Hold(std::int64_t step, Clock::Time most) {
  clock_->SleepUntil(clock_->Now() + most);
  start_ = clock_->Now();
  start_step_ = step;
  return {};
}

void Pacer::Resume(std::int64_t step, double speed) {
  speed_ = speed;
  still_ = false;
  start_ = clock_->Now();
  start_step_ = step;
  window_start_ = start_;
  window_step_ = step;
  reading_.lateness = 0;
  reading_.real_time_factor = 0;
}

void Pacer::Measure(std::int64_t step, Clock::Time now) {
  const Clock::Time wall = now - window_start_;
  if (wall < std::chrono::seconds(1)) return;
  reading_.real_time_factor = Seconds((step - window_step_) * period_) / Seconds(wall);
  window_start_ = now;
  window_step_ = step;
}

}  // namespace understudy::time
