#include "drive/stiction.h"

#include <algorithm>
#include <cmath>

namespace understudy::drive {

void Stiction::Restart() { std::ranges::fill(joints_, Joint{}); }

bool Stiction::Step(std::size_t motor, bool driven, double rate, double dt) {
  Joint& joint = joints_[motor];
  const double speed = std::abs(rate);
  if (driven || speed > kMoves) {
    joint = {};
  } else if (!joint.sticks) {
    joint.rest = speed < kStill ? joint.rest + dt : 0;
    joint.sticks = joint.rest >= kAfter;
  }
  return joint.sticks;
}

}  // namespace understudy::drive
