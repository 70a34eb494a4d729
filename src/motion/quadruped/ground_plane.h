// The ground under a walking robot, as its feet found it.
#pragma once

#include <Eigen/Core>

#include "motion/quadruped/body.h"

namespace understudy::motion {

// The plane through the centres of the feet where they stand or last stood, in the least squares.
// Its slope follows slowly.
class GroundPlane {
 public:
  void Begin() { slope_.setZero(); }
  // One step of dt [s].
  void Update(const PerLeg& feet, double dt);

  double HeightAt(const Eigen::Vector3d& p) const { return middle_.z() + slope_.dot(p - middle_); }
  // Rise per metre along x and y; z is 0.
  const Eigen::Vector3d& slope() const { return slope_; }

 private:
  Eigen::Vector3d middle_{0, 0, 0}, slope_{0, 0, 0};
};

}  // namespace understudy::motion
