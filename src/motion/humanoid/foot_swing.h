// The way of a humanoid's foot from the ground to where it lands.
#pragma once

#include <Eigen/Core>

namespace understudy::motion {

// The wanted motion of a foot's sole, world axes. The landing may change on the way: what is left
// of it is planned anew in each step. Allocates nothing.
class FootSwing {
 public:
  // At rest at `p` [m] with that heading [rad].
  void Begin(const Eigen::Vector3d& p, double yaw);

  // Goes on for dt [s]: `elapsed` of `time` s since it left the ground, to land at `landing` [m]
  // with the heading `yaw` [rad], after it was lifted by `raise` m.
  void Step(double elapsed, double time, const Eigen::Vector3d& landing, double yaw, double raise,
            double dt);

  const Eigen::Vector3d& p() const { return p_; }  // m
  const Eigen::Vector3d& v() const { return v_; }  // m/s
  const Eigen::Vector3d& a() const { return a_; }  // m/s²
  double yaw() const { return yaw_; }              // rad

 private:
  Eigen::Vector3d p_{0, 0, 0}, v_{0, 0, 0}, a_{0, 0, 0};
  double from_z_ = 0, from_yaw_ = 0, yaw_ = 0;
};

}  // namespace understudy::motion
