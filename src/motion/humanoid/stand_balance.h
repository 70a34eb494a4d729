// Standing on two feet without a step.
#pragma once

#include <array>
#include <span>

#include "motion/humanoid/body_model.h"

namespace understudy::motion {

// What the ground is to answer one foot with, at the centre of its sole, world axes.
struct GroundReaction {
  Eigen::Vector3d force{0, 0, 0};   // N
  Eigen::Vector3d moment{0, 0, 0};  // N·m
};

// Where the body is wanted, from the middle of the soles.
struct StandGoal {
  Eigen::Vector2d com_offset{0, 0};  // m, of the centre of mass, x forwards, y left
  double base_height = 0;            // m, of the base body
  double pitch = 0;                  // rad, of the base; its roll is 0, its yaw that of the soles
};

// Where the centre of mass is now, as StandGoal::com_offset says it.
Eigen::Vector2d ComOffset(const BodyModel& body);

// Reactions that keep the centre of mass over the soles and the base upright. The centre of mass is
// taken for a linear inverted pendulum over the point the ground presses at, p:
//
//   ω² = g / height     ξ = c + ċ / ω     p = ξ_goal + k (ξ - ξ_goal)     force = m ω² (c - p)
//
// (ξ: capture point, Pratt et al. 2006, Englsberger et al. 2011.) Height and attitude are springs
// and dampers. Whatever the sum is, p stays within the soles, and is shared out to them by their
// distance from it, so a foot is never asked to pull or to stand on its edge.
class StandBalance {
 public:
  // One step of dt [s]. `load`: what part of its weight the robot has on its feet, 0 to 1; what the
  // ground answers is scaled with it. `body` has two soles.
  void Step(const BodyModel& body, const StandGoal& goal, double load, double dt);

  // The weight alone, under the centre of mass or as near to it as the soles go: what joints that
  // are held need beside their springs.
  void Rest(const BodyModel& body, double load);

  // Of the last step; 0 before.
  std::span<const GroundReaction> reactions() const { return reactions_; }

 private:
  void Share(const BodyModel& body, Eigen::Vector2d p, const Eigen::Vector3d& force, double turn);

  std::array<GroundReaction, 2> reactions_{};
  Eigen::Vector2d velocity_{0, 0};  // of the centre of mass, m/s, smoothed
  Eigen::Vector3d rate_{0, 0, 0};   // of the base, rad/s, likewise
  bool fresh_ = true;
};

}  // namespace understudy::motion
