// Rounds to a sensor's resolution.
#pragma once

#include <cmath>

namespace understudy::sensors {

// std::round(value / step) * step to the last bit, sign of zero included; `step` > 0. Written out,
// since x86-64 as such has no instruction that rounds, and a call for each reading takes longer.
inline double OnLattice(double value, double step) {
  constexpr double kWholeOnly = 0x1p52;  // between it and its double numbers are whole
  const double steps = value / step;
  if (!(std::abs(steps) < kWholeOnly / 2)) return std::round(steps) * step;  // or not a number
  double whole = (steps + 1.5 * kWholeOnly) - 1.5 * kWholeOnly;
  if (std::abs(steps - whole) == 0.5) whole = std::round(steps);  // the sum goes to the even one
  return std::copysign(whole, steps) * step;
}

}  // namespace understudy::sensors
