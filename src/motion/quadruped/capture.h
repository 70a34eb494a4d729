// Where a pushed robot would have to put its feet to come to rest.
#pragma once

#include <Eigen/Core>

#include "motion/quadruped/body.h"

namespace understudy::motion {

// Seen from above in frame T: where the robot, taken for a pendulum that falls with the rate
// `omega` [rad/s], comes to rest over when its base moves with v_WB_W [m/s]; from the base's
// origin, m.
Eigen::Vector3d CapturePoint(const QuadrupedReading& sensed, const Eigen::Vector3d& v_WB_W,
                             double omega);

// How far that point is out between the feet: 0 in their middle, 1 over an edge, more beyond it.
double Overhang(const QuadrupedReading& sensed, const Eigen::Vector3d& point);

// Whether it must step to stay on its feet: that point is far out, and the robot moves against its
// feet with v [m/s, world] too fast to be only leaning.
bool MustStep(const QuadrupedReading& sensed, const Eigen::Vector3d& v, double omega);

// Whether the point is nearer to the line from FR to RL than to that from FL to RR.
bool NearerToFrontRight(const QuadrupedReading& sensed, const Eigen::Vector3d& point);

}  // namespace understudy::motion
