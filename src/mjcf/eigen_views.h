// Views of MuJoCo's arrays as Eigen types.
#pragma once

#include <Eigen/Geometry>

namespace understudy::mjcf {

// A rotation matrix of nine numbers in row-major order.
using RotationView = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

inline Eigen::Vector3d Vector(const double* x) { return {x[0], x[1], x[2]}; }
inline Eigen::Quaterniond Quaternion(const double* q) { return {q[0], q[1], q[2], q[3]}; }

}  // namespace understudy::mjcf
