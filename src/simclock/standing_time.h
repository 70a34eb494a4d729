// Real time for what Understudy's own code does in a program on the clock.
#pragma once

namespace understudy::simclock {

// While it exists the thread that made it is on real time, and simulated time stands, also while
// the thread waits: for an answer of the robot's housekeeping, which comes in real time. Nothing
// that needs a step of the robot may be waited for. To make it takes 10 ms of simulated time, or
// none while the robot is paused, so that a loop that asks again and again ends. Does nothing in a
// process that is not on the clock. Not for two at once in a thread.
class StandingTime {
 public:
  StandingTime();
  ~StandingTime();
  StandingTime(const StandingTime&) = delete;
  StandingTime& operator=(const StandingTime&) = delete;
};

}  // namespace understudy::simclock
