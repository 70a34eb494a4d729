#include "motion/quadruped/swing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace understudy::motion {

// Cycloids: unitree_guide's FeetEndCal.cpp.
FootMotion SwingFoot(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double raise,
                     double time, double s) {
  constexpr double kTurn = 2 * std::numbers::pi;
  s = std::clamp(s, 0.0, 1.0);
  const double sine = std::sin(kTurn * s), cosine = std::cos(kTurn * s);
  const Eigen::Vector3d way = to - from;
  const Eigen::Vector3d lift(0, 0, raise / 2);
  return {.p = from + (s - sine / kTurn) * way + (1 - cosine) * lift,
          .v = ((1 - cosine) * way + kTurn * sine * lift) / time,
          .a = (kTurn * sine * way + kTurn * kTurn * cosine * lift) / (time * time)};
}

}  // namespace understudy::motion
