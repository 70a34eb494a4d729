// Rotations from angles.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace understudy::robot {

// Returns R = Rz(yaw) Ry(pitch) Rx(roll) of roll, pitch and yaw [rad].
inline Eigen::Matrix3d FromRollPitchYaw(const Eigen::Vector3d& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace understudy::robot
