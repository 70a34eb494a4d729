// Where a quadruped is asked to go.
#pragma once

#include <Eigen/Core>

#include "authority/goals.h"
#include "motion/quadruped/path.h"

namespace understudy::motion {

// The velocity that the last Move asks for as long as it counts, or a path. Places are x, y [m] and
// yaw [rad] of the robot's own estimate. Allocates nothing but what a path needs.
class AskedWay {
 public:
  // Takes a Move, FollowPath or GoTo in place of what was asked for before; false for other goals.
  // `sticks` is what the speed level makes of the sticks' velocities.
  bool Take(const authority::MotionGoal& goal, double sticks, const Eigen::Vector3d& here);

  // Nothing is asked for any more.
  void End();

  // Whether a program's Move lasts until the next one or StopMove.
  void Last(bool on) { lasting_ = on; }

  // Whether what was asked for last avoids obstacles.
  bool avoids() const { return avoids_; }

  // One step of dt [s]: forward, left m/s, turn rad/s.
  Eigen::Vector3d Step(double dt, const Eigen::Vector3d& here);

 private:
  PathFollower path_;
  Eigen::Vector3d velocity_{0, 0, 0};  // of the last Move: m/s, rad/s
  double counts_for_ = 0;              // s that it still does
  bool lasting_ = false;
  bool avoids_ = false;
};

}  // namespace understudy::motion
