// Turns a commanded velocity into that of a walking robot.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "robot/motion_spec.h"

namespace understudy::motion {

// Turns commanded velocities into those that the gait is to have: cut to what the gait is good
// for, nothing where all are within the dead band, slower where a bend would throw the robot aside;
// then dead time, gain and a lag of first order, per axis. Axes are forward and left m/s, turn
// rad/s. Allocates nothing.
class VelocityWish {
 public:
  // `most` is the most acceleration, m/s² and rad/s².
  explicit VelocityWish(const robot::WalkSpec& spec, double most = 1e3)
      : spec_(spec), most_(most) {}

  // Nothing is asked for, the gait has that velocity.
  void Begin(const Eigen::Vector3d& velocity = {0, 0, 0});
  void Ask(const Eigen::Vector3d& wish) { wish_ = Taken(wish); }
  void Step(double dt);
  // Whether it follows with less lag.
  void Hurry(bool on) { hurries_ = on; }

  // What the gait would take of that wish; nothing where it is not worth a step.
  Eigen::Vector3d Taken(const Eigen::Vector3d& wish) const;
  // As of the last Step.
  const Eigen::Vector3d& velocity() const { return velocity_; }
  const Eigen::Vector3d& acceleration() const { return acceleration_; }
  // Nothing is asked for or still to come.
  bool at_rest() const;

 private:
  static constexpr std::size_t kDelayed = 256;

  const robot::WalkSpec& spec_;
  double most_;
  bool hurries_ = false;
  Eigen::Vector3d wish_{0, 0, 0};
  std::array<Eigen::Vector3d, kDelayed> delayed_;  // a ring of wishes, one a step
  std::size_t next_ = 0;
  Eigen::Vector3d velocity_{0, 0, 0}, acceleration_{0, 0, 0};
};

}  // namespace understudy::motion
