// Decides in which steps something periodic is due.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace understudy::robot {

// A rate of `hz` per second of simulated time for steps of `timestep` seconds. It is due in step 0
// and then after every period, rounded to whole steps.
class Rate {
 public:
  Rate(double hz, double timestep)
      : every_(std::max(1LL, std::llround(1e9 / (hz * std::round(timestep * 1e9))))) {}

  bool Due(std::int64_t step) const { return step % every_ == 0; }
  std::int64_t every() const { return every_; }  // steps

 private:
  std::int64_t every_;
};

}  // namespace understudy::robot
