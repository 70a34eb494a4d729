#include "motion/quadruped/ground_plane.h"

#include <algorithm>

namespace understudy::motion {

using Eigen::Vector3d;

void GroundPlane::Update(const PerLeg& feet, double dt) {
  constexpr double kTime = 0.1;  // s, assumed
  middle_ = (feet[0] + feet[1] + feet[2] + feet[3]) / 4;
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
  for (const Vector3d& foot : feet) {
    const Vector3d d = foot - middle_;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
    xz += d.x() * d.z();
    yz += d.y() * d.z();
  }
  const double determinant = std::max(xx * yy - xy * xy, 1e-9);
  const Vector3d slope((xz * yy - yz * xy) / determinant, (yz * xx - xz * xy) / determinant, 0);
  slope_ += std::min(dt / kTime, 1.0) * (slope - slope_);
}

}  // namespace understudy::motion
