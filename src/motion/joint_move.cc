#include "motion/joint_move.h"

#include <algorithm>

namespace understudy::motion {

double SmoothStep(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

double SmoothStepRate(double s) {
  if (s <= 0 || s >= 1) return 0;
  return 30 * s * s * (s - 1) * (s - 1);
}

void JointMove::Begin(std::span<const double> from, std::span<const double> to, double duration) {
  std::copy(from.begin(), from.end(), from_.begin());
  std::copy(to.begin(), to.end(), to_.begin());
  duration_ = duration;
  elapsed_ = 0;
}

double JointMove::q(std::size_t joint) const {
  if (over()) return to_[joint];
  return from_[joint] + SmoothStep(elapsed_ / duration_) * (to_[joint] - from_[joint]);
}

double JointMove::dq(std::size_t joint) const {
  if (over()) return 0;
  return SmoothStepRate(elapsed_ / duration_) / duration_ * (to_[joint] - from_[joint]);
}

}  // namespace understudy::motion
