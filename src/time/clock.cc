#include "time/clock.h"

#include <ctime>

namespace understudy::time {

Clock::Time SteadyClock::Now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

void SteadyClock::SleepUntil(Time deadline) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(deadline);
  const timespec until{.tv_sec = seconds.count(), .tv_nsec = (deadline - seconds).count()};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace understudy::time
