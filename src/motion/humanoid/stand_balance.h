// Balances a humanoid on two feet without steps.
#pragma once

#include <array>
#include <span>

#include "motion/humanoid/body_model.h"

namespace understudy::motion {

// The wanted ground reaction on a foot, at the centre of its sole, world axes.
struct GroundReaction {
  Eigen::Vector3d force{0, 0, 0};   // N
  Eigen::Vector3d moment{0, 0, 0};  // N·m
};

// The wanted pose of the body relative to the middle of the soles.
struct StandGoal {
  Eigen::Vector2d com_offset{0, 0};  // m, of the centre of mass, x forwards, y left
  double base_height = 0;            // m, of the base body
  double pitch = 0;                  // rad, of the base; its roll is 0, its yaw that of the soles
};

// Returns the present StandGoal::com_offset.
Eigen::Vector2d ComOffset(const BodyModel& body);

// Computes reactions that keep the centre of mass over the soles and the base upright. The model is
// a linear inverted pendulum over the centre of pressure p:
//
//   ω² = g / height     ξ = c + ċ / ω     p = ξ_goal + k (ξ - ξ_goal)     force = m ω² (c - p)
//
// (ξ: capture point, Pratt et al. 2006, Englsberger et al. 2011.) Height and attitude have springs
// and dampers. p is clamped to the soles and shared between them by their distance from it, so that
// no foot has to pull or stand on its edge.
class StandBalance {
 public:
  // Makes one step of dt [s]. `load`, 0 to 1, is the share of the weight on the feet; it scales the
  // reactions. `body` must have two soles.
  void Step(const BodyModel& body, const StandGoal& goal, double load, double dt);

  // Computes reactions to the weight only, under the centre of mass or the nearest point of the
  // soles: the feed-forward of locked joints.
  void CarryWeight(const BodyModel& body, double load);

  // Returns the reactions of the last step; zeros before.
  std::span<const GroundReaction> reactions() const { return reactions_; }

 private:
  void Share(const BodyModel& body, Eigen::Vector2d p, const Eigen::Vector3d& force, double turn);

  std::array<GroundReaction, 2> reactions_{};
  Eigen::Vector2d velocity_{0, 0};  // of the centre of mass, m/s, smoothed
  Eigen::Vector3d rate_{0, 0, 0};   // of the base, rad/s, smoothed
  bool fresh_ = true;
};

}  // namespace understudy::motion
