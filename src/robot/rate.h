// How often something happens, counted in steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace understudy::robot {

// `hz` times a second of simulated time, which goes on in steps of `timestep` seconds: in step 0
// and in every so manyth after it, to the nearest whole number of steps.
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
