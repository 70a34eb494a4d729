// Rotations as the vendor's angles and as vectors.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "robot/rotations.h"

namespace understudy::motion {

using robot::FromRollPitchYaw;

// The inverse of FromRollPitchYaw; pitch within ±π/2.
inline Eigen::Vector3d RollPitchYaw(const Eigen::Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)),
          std::atan2(R(1, 0), R(0, 0))};
}

// The axis, as long as the angle [rad].
inline Eigen::Vector3d RotationVector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

}  // namespace understudy::motion
