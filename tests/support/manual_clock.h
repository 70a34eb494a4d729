// A clock that tests turn by hand.
#pragma once

#include "time/clock.h"

namespace understudy::test {

// Changes only by Advance and by SleepUntil, which sets it to the deadline.
class ManualClock final : public time::Clock {
 public:
  Time Now() override { return now_; }
  void SleepUntil(Time deadline) override {
    if (deadline > now_) now_ = deadline;
  }
  void Advance(Time by) { now_ += by; }

 private:
  Time now_{0};
};

}  // namespace understudy::test
