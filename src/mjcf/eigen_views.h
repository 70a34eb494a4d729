// MuJoCo's arrays of numbers as Eigen's types.
#pragma once

#include <Eigen/Geometry>

namespace understudy::mjcf {

// The nine numbers of a rotation matrix where they stand, row by row.
using RotationView = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

inline Eigen::Vector3d Vector(const double* x) { return {x[0], x[1], x[2]}; }
inline Eigen::Quaterniond Quaternion(const double* q) { return {q[0], q[1], q[2], q[3]}; }

}  // namespace understudy::mjcf
