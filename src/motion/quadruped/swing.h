// The way of a foot from one place on the ground to the next.
#pragma once

#include <Eigen/Core>

namespace understudy::motion {

struct FootMotion {
  Eigen::Vector3d p, v, a;  // m, m/s, m/s²
};

// At the part `s` of a swing of `time` s: straight from `from` to `to`, smoothly, and in between
// `raise` m over the way. At both ends it has no speed.
FootMotion SwingFoot(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double raise,
                     double time, double s);

}  // namespace understudy::motion
