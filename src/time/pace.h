// The requested pace of simulated time: its speed, and whether it is paused.
#pragma once

#include <cstdint>

namespace understudy::time {

// *Assumed*: a lower speed is as good as a pause, and no machine reaches the highest.
inline constexpr double kLeastSpeed = 0.001;
inline constexpr double kMostSpeed = 1000;
inline constexpr char kSpeedRange[] = "a number from 0.001 to 1000, or max";
// Whether a user may ask for that number; for as fast as possible the word is max.
constexpr bool IsSpeed(double speed) { return speed >= kLeastSpeed && speed <= kMostSpeed; }

// Set by requests; the loop that calls the tick follows it.
struct Pace {
  double speed = 1;  // simulated seconds per wall second; 0 = as fast as possible
  bool paused = false;
  std::int64_t steps_left = 0;  // steps to make while paused

  bool stands_still() const { return paused && steps_left == 0; }
};

}  // namespace understudy::time
