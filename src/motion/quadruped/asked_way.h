// Where a quadruped is asked to go.
#pragma once

#include <Eigen/Core>

#include "authority/goals.h"
#include "motion/quadruped/avoidance.h"
#include "motion/quadruped/path.h"

namespace understudy::motion {

// The velocity that the last Move asks for as long as it counts, or a path. Places are x, y [m] and
// yaw [rad] of the robot's own estimate. Allocates nothing but what a path needs.
class AskedWay {
 public:
  // `sidesteps` as Avoidance has it.
  explicit AskedWay(bool sidesteps) : avoidance_(sidesteps) {}

  // Takes a Move, FollowPath or GoTo in place of what was asked for before; false for other goals.
  // `sticks` is what the speed level makes of the sticks' velocities.
  bool Take(const authority::MotionGoal& goal, double sticks, const Eigen::Vector3d& here);

  // Nothing is asked for any more.
  void End();

  // Whether a program's Move lasts until the next one or StopMove.
  void Last(bool on) { lasting_ = on; }

  // Whether it avoids obstacles, or did until just now: what comes next then finds them known.
  bool avoids() const { return avoided_ < kLooksOn; }

  // One step of dt [s]: forward, left m/s, turn rad/s. `obstacles` are null where none can be seen.
  Eigen::Vector3d Step(double dt, const Eigen::Vector3d& here,
                       const robot::SeenObstacles* obstacles);

 private:
  static constexpr double kLooksOn = 2;  // s; *assumed*

  Eigen::Vector3d Asked(double dt, const Eigen::Vector3d& here);

  PathFollower path_;
  Avoidance avoidance_;
  Eigen::Vector3d velocity_{0, 0, 0};  // of the last Move: m/s, rad/s
  double counts_for_ = 0;              // s that it still does
  bool lasting_ = false;
  bool avoids_ = false;        // what was asked for last
  double avoided_ = kLooksOn;  // s ago that it last did
};

}  // namespace understudy::motion
