// How simulated time is to go on.
#pragma once

#include <cstdint>

namespace understudy::time {

// *Assumed*: slower than the slowest is a pause, and no machine reaches the fastest.
inline constexpr double kLeastSpeed = 0.001;
inline constexpr double kMostSpeed = 1000;
inline constexpr char kSpeedRange[] = "0 (as fast as possible) or 0.001 to 1000";
constexpr bool IsSpeed(double speed) {
  return speed == 0 || (speed >= kLeastSpeed && speed <= kMostSpeed);
}

// As orders have it. Whoever calls the tick keeps to it.
struct Pace {
  double speed = 1;  // simulated seconds per wall second; 0 = as fast as possible
  bool paused = false;
  std::int64_t steps_left = 0;  // to be made although paused

  bool stands_still() const { return paused && steps_left == 0; }
};

}  // namespace understudy::time
