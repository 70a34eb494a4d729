// Follows how regularly rt/lowstate arrives.
#pragma once

#include <algorithm>

#include "doctor/measurements.h"
#include "time/clock.h"

namespace understudy::doctor {

class StatesWatch {
 public:
  explicit StatesWatch(time::Clock::Time start) : first_(start), last_(start) {}

  // Takes note of a state that has arrived.
  void Note(time::Clock::Time now) {
    if (count_ == 0) {
      first_ = now;
    } else {
      longest_ = std::max(longest_, now - last_);
    }
    last_ = now;
    ++count_;
  }

  // Between the first and the last.
  States states() const {
    using Seconds = std::chrono::duration<double>;
    const double span = Seconds(last_ - first_).count();
    return {.count = count_,
            .rate = span > 0 ? static_cast<double>(count_ - 1) / span : 0,
            .longest_pause = Seconds(longest_).count()};
  }

 private:
  time::Clock::Time first_, last_, longest_{0};
  std::size_t count_ = 0;
};

}  // namespace understudy::doctor
