// Following a path by a robot's own estimate of where it is.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "authority/goals.h"

namespace understudy::motion {

// Makes velocities that lead along points in the plane, each to be passed at its time: those of the
// path between two points, and what brings the robot back to it. Places are x, y [m] and yaw [rad]
// of the estimate. Allocates nothing while a path has no more points than it has had room for.
class PathFollower {
 public:
  PathFollower() { points_.reserve(kRoom); }

  // From `here` over `points` to the last of them. Empty: nothing is followed.
  void Begin(std::span<const authority::goal::PathPoint> points, const Eigen::Vector3d& here);
  // Straight to `place`, as fast as a robot goes that nobody hurries.
  void GoTo(const Eigen::Vector3d& place, const Eigen::Vector3d& here);
  void End() { points_.clear(); }

  // It has arrived, or the time for that is over.
  bool over() const { return points_.empty(); }

  // One step of dt [s]. Forward, left m/s, turn rad/s.
  Eigen::Vector3d Step(double dt, const Eigen::Vector3d& here);

 private:
  static constexpr std::size_t kRoom = 512;

  std::vector<authority::goal::PathPoint> points_;  // the first is where it began
  double t_ = 0, there_ = 0;  // s since Begin, and that it has been at the end
};

}  // namespace understudy::motion
