// Decides in which steps something periodic is due.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace understudy::robot {

// A rate of `hz` per second of simulated time for steps of `timestep` seconds, at most once a step.
// It is due in step 0 and then in the first step at or after the end of every period: always the
// same number of steps apart if the period is a whole number of them, else now one more and now one
// less, with the rate as their mean.
class Rate {
 public:
  Rate(double hz, double timestep) {
    const auto step_ns = static_cast<double>(std::llround(timestep * 1e9));
    const double exact = 1e9 / (hz * step_ns);
    const double whole = std::round(exact);
    if (whole >= 1 && std::abs(exact - whole) <= 1e-6 * exact) {
      steps_ = std::llround(whole);
      return;
    }
    constexpr double kMilli = 1e3;  // periods are counted in mHz times ns
    periods_ = std::max(1LL, std::llround(hz * kMilli) * std::llround(step_ns));
    steps_ = std::llround(1e9 * kMilli);
    const std::int64_t common = std::gcd(periods_, steps_);
    periods_ /= common;
    steps_ /= common;
  }

  bool Due(std::int64_t step) const { return step * periods_ % steps_ < periods_; }
  // Steps of a period, rounded to whole ones.
  std::int64_t every() const { return std::max<std::int64_t>(1, steps_ / periods_); }

 private:
  std::int64_t periods_ = 1, steps_ = 1;  // so many periods in so many steps
};

}  // namespace understudy::robot
