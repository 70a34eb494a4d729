// The angles of a rotation.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace understudy::wire {

// Returns roll, pitch, yaw [rad] of a unit quaternion: R = Rz(yaw) Ry(pitch) Rx(roll), pitch in
// ±π/2, roll and yaw in ±π. Never NaN for finite input; at pitch ±π/2, where only the sum or
// difference of roll and yaw is determined, both are finite.
inline Eigen::Vector3d RollPitchYaw(const Eigen::Quaterniond& R_WI) {
  const double w = R_WI.w();
  const double x = R_WI.x();
  const double y = R_WI.y();
  const double z = R_WI.z();
  return {std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
          std::asin(std::clamp(2 * (w * y - z * x), -1.0, 1.0)),
          std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))};
}

}  // namespace understudy::wire
