#include "motion/quadruped/capture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

PerLeg FeetInT(const QuadrupedReading& sensed) {
  PerLeg feet;
  for (std::size_t leg = 0; leg < feet.size(); ++leg) feet[leg] = sensed.R_TB * sensed.feet[leg];
  return feet;
}

// m, of `p` to the left of the way from `a` to `b`.
double LeftOf(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const Vector3d way = b - a, to = p - a;
  constexpr double kShort = 1e-6;  // m
  return (way.x() * to.y() - way.y() * to.x()) / std::max(std::hypot(way.x(), way.y()), kShort);
}

}  // namespace

Vector3d CapturePoint(const QuadrupedReading& sensed, const Vector3d& v_WB_W, double omega) {
  const Vector3d v_com = sensed.R_WB.transpose() * v_WB_W + sensed.w_WB_B.cross(sensed.com);
  return sensed.R_TB * (sensed.com + v_com / omega);
}

double Overhang(const QuadrupedReading& sensed, const Vector3d& point) {
  const PerLeg feet = FeetInT(sensed);
  const Vector3d middle = (feet[0] + feet[1] + feet[2] + feet[3]) / 4;
  constexpr std::array<std::size_t, 5> kAround{0, 1, 3, 2, 0};  // FR FL RL RR, to the left
  double most = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d &a = feet[kAround[i]], &b = feet[kAround[i + 1]];
    const double room = LeftOf(a, b, middle);
    if (room <= 0) return std::numeric_limits<double>::infinity();
    most = std::max(most, 1 - LeftOf(a, b, point) / room);
  }
  return most;
}

bool MustStep(const QuadrupedReading& sensed, const Vector3d& v, double omega) {
  constexpr double kToppling = 0.6;  // of the way out to an edge of the feet; assumed
  constexpr double kShoved = 0.25;   // m/s, assumed
  return v.head<2>().norm() > kShoved &&
         Overhang(sensed, CapturePoint(sensed, v, omega)) > kToppling;
}

bool NearerToFrontRight(const QuadrupedReading& sensed, const Vector3d& point) {
  const PerLeg feet = FeetInT(sensed);
  return std::abs(LeftOf(feet[0], feet[3], point)) < std::abs(LeftOf(feet[1], feet[2], point));
}

}  // namespace understudy::motion
