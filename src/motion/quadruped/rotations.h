// Rotations as the vendor's angles and as vectors.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace understudy::motion {

// Rz(yaw) Ry(pitch) Rx(roll) of roll, pitch and yaw [rad].
inline Eigen::Matrix3d FromRollPitchYaw(const Eigen::Vector3d& rpy) {
  return (Eigen::AngleAxisd(rpy[2], Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy[0], Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

// Its inverse; pitch within ±π/2.
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
