// Rounds values to the integers of the messages.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

#include "robot/robot_spec.h"

namespace understudy::wire {

// Returns x rounded to the nearest integer in lo..hi; NaN becomes lo.
template <std::integral Int>
Int Rounded(double x, Int lo = std::numeric_limits<Int>::min(),
            Int hi = std::numeric_limits<Int>::max()) {
  if (!(x > static_cast<double>(lo))) return lo;
  if (x >= static_cast<double>(hi)) return hi;
  return static_cast<Int>(std::lround(x));
}

// Returns the foot_force value of a force [N]: counts, 0..4095.
inline std::int16_t FootCounts(double force, const robot::FootSensorSpec& sensor) {
  return Rounded<std::int16_t>(sensor.offset_counts + sensor.counts_per_newton * force, 0, 4095);
}

}  // namespace understudy::wire
