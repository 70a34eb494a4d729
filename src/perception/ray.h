// A ray, and what it meets.
#pragma once

#include <limits>

#include <Eigen/Core>

namespace understudy::perception {

struct Ray {
  Eigen::Vector3d origin;     // m
  Eigen::Vector3d direction;  // of length 1
};

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

struct Hit {
  double distance = kNoHit;  // m, never negative
  int geom = -1;             // of the model
};

}  // namespace understudy::perception
