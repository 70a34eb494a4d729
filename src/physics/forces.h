// Forces from outside on bodies of the robot: pushes and drags.
#pragma once

#include <span>
#include <vector>

#include "physics/world.h"

namespace understudy::physics {

// What acted on a body in a step, world axes.
struct AppliedForce {
  int body = 0;
  Eigen::Vector3d p_WP{0, 0, 0};     // m, where
  Eigen::Vector3d force_W{0, 0, 0};  // N
};

// Constant forces on centres of mass. Times are simulated and never go back. Allocates in the
// constructor only.
class Pushes {
 public:
  static constexpr std::size_t kMost = 16;  // at a time

  Pushes();

  // Acts in all steps that begin before `until` [s]. False when there are as many as there can be.
  bool Begin(int body, const Eigen::Vector3d& force_W, double until);
  void Clear();

  // Adds the forces to the step that begins at t [s].
  void Act(double t, World* world);
  // Those of the last step.
  std::span<const AppliedForce> forces() const { return forces_; }

 private:
  struct Push {
    int body;
    Eigen::Vector3d force_W;
    double until;  // s
  };

  std::vector<Push> pushes_;
  std::vector<AppliedForce> forces_;
};

// Damped springs from points of bodies to points in the world, one a body, as a hand or a mouse
// drags. With p the point that is dragged, v its velocity and m the mass of the body and all that
// hangs on it:
//
//   force = m · (w² · (target - p) - 2 · w · v),  |force| <= m · 50 m/s²
//
// w² = 100 1/s² is the stiffness that MuJoCo's own viewer drags with unless its model says
// otherwise. The critical damping and the bound, five times the weight, are *assumed*.
class Drags {
 public:
  static constexpr std::size_t kMost = 8;  // at a time

  Drags();

  // Begins to drag, or from now on drags otherwise, the point p_BP of a body to p_WT, in all steps
  // that begin before `until` [s]. False when there are as many as there can be.
  bool Pull(int body, const Eigen::Vector3d& p_BP, const Eigen::Vector3d& p_WT, double until);
  void Release(int body);
  std::size_t size() const { return drags_.size(); }
  void Clear();

  // As for pushes.
  void Act(double t, World* world);
  std::span<const AppliedForce> forces() const { return forces_; }

 private:
  struct Drag {
    int body;
    Eigen::Vector3d p_BP;
    Eigen::Vector3d p_WT;
    double until;  // s
  };

  std::vector<Drag> drags_;
  std::vector<AppliedForce> forces_;
};

}  // namespace understudy::physics
