// Reads wall time and sleeps.
#pragma once

#include <chrono>

namespace understudy::time {

class Clock {
 public:
  using Time = std::chrono::nanoseconds;  // since an arbitrary origin; never goes back

  virtual ~Clock() = default;
  virtual Time Now() = 0;
  // Returns at `deadline` or later, immediately if it has passed. A signal may end the wait early.
  virtual void SleepUntil(Time deadline) = 0;
};

// CLOCK_MONOTONIC.
class SteadyClock final : public Clock {
 public:
  Time Now() override;
  void SleepUntil(Time deadline) override;
};

}  // namespace understudy::time
