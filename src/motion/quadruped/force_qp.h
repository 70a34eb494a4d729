// Shares a wrench among the feet that can push.
#pragma once

#include <array>

#include <Eigen/Core>

#include "motion/quadruped/body.h"

namespace understudy::motion {

// What the feet are to do together, and what each of them can. Any axes with z up; N, m.
struct ForceTask {
  Eigen::Vector3d force{0, 0, 0};   // of all feet
  Eigen::Vector3d moment{0, 0, 0};  // about the centre of mass
  PerLeg arms{};                    // to each foot from there
  std::array<double, 4> least{};    // vertical force of each foot
  std::array<double, 4> most{};     // 0: the foot is in the air
  double friction = 0;              // of the ground
  double weight = 1;                // of the robot: what forces are measured by
  double length = 1;                // what moments are measured by, with the weight
  PerLeg last{};                    // the forces of the step before: changes are kept small
};

// The forces [N] of the feet within their friction cones, cut to octagons, that do the task best,
// in weighted least squares: orientation before height before the rest, small forces and small
// changes before large ones. Weights: BalanceCtrl.cpp of unitree_guide
// (docs/dev/sources.md#algorithms-and-training-environments), made independent of the robot's size.
// Solved by the dual active-set method of Goldfarb and Idnani, A numerically stable dual method for
// solving strictly convex quadratic programs, Mathematical Programming 27 (1983). Allocates
// nothing.
PerLeg ShareForces(const ForceTask& task);

}  // namespace understudy::motion
