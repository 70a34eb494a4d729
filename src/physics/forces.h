// External forces on bodies of the robot: pushes and drags.
#pragma once

#include <span>
#include <vector>

#include "physics/mujoco_world.h"

namespace understudy::physics {

// A force that acted on a body in a step, world axes.
struct AppliedForce {
  int body = 0;
  Eigen::Vector3d p_WP{0, 0, 0};     // m, where
  Eigen::Vector3d force_W{0, 0, 0};  // N
};

// Constant forces on centres of mass. Times are simulated and never go back. Allocates only in the
// constructor.
class Pushes {
 public:
  static constexpr std::size_t kMost = 16;  // at a time

  Pushes();

  // Starts a push, which acts in all steps that begin before `until` [s]. Returns false if there
  // are kMost already.
  bool Begin(int body, const Eigen::Vector3d& force_W, double until);
  void Clear();

  // Adds the forces to the step that begins at t [s].
  void Act(double t, MujocoWorld* world);
  // Returns the forces of the last step.
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

// Damped springs from points of bodies to points in the world, at most one per body, as for
// dragging with the mouse. With p the dragged point, v its velocity and m the mass of the body and
// its subtree:
//
//   force = m · (w² · (target - p) - 2 · w · v),  |force| <= m · 50 m/s²
//
// w² = 100 1/s² is the default stiffness of MuJoCo's viewer. The critical damping and the bound,
// five times the weight, are *assumed*.
class Drags {
 public:
  static constexpr std::size_t kMost = 8;  // at a time

  Drags();

  // Drags the point p_BP of a body to p_WT in all steps that begin before `until` [s]; replaces an
  // earlier drag of that body. Returns false if there are kMost already.
  bool Pull(int body, const Eigen::Vector3d& p_BP, const Eigen::Vector3d& p_WT, double until);
  void Release(int body);
  std::size_t size() const { return drags_.size(); }
  void Clear();

  // As in Pushes.
  void Act(double t, MujocoWorld* world);
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
