// Rolling on wheels under a body that stands.
#pragma once

#include <array>

#include <Eigen/Core>

#include "motion/quadruped/estimator.h"
#include "motion/quadruped/stance.h"
#include "motion/quadruped/velocity_wish.h"

namespace understudy::motion {

// How fast the feet roll over the ground, by the rates of the legs and wheels: m/s, world.
Eigen::Vector3d RollingVelocity(const QuadrupedReading& sensed);

// The stance holds the body, the wheels run: straight ahead with the speed that is wanted, in a
// turn faster on the outer side than on the inner one, as the tyres have to slip; what the
// gyroscope and the estimator find missing is added. Wheels cannot go sideways: that part of a wish
// is left out. Allocates nothing.
class Drive final : public Behaviour {
 public:
  // All must outlive it; the stance has begun.
  Drive(const QuadrupedBody& body, const QuadrupedEstimator& estimator, Stance* stance,
        const robot::QuadrupedMotionSpec& spec)
      : body_(body),
        estimator_(estimator),
        stance_(stance),
        spec_(spec.walk),
        wish_(spec.walk, kMostAcceleration) {}

  void Begin();
  void Ask(const Eigen::Vector3d& velocity);  // forward, left m/s, turn rad/s
  void Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) override;

  // Nothing is asked for, and it has come to rest.
  bool over() const override { return over_; }
  // How fast the wheels are to turn against the world, FR FL RR RL, rad/s.
  const std::array<double, 4>& rates() const { return rates_; }

 private:
  // m/s² and rad/s², assumed: faster, and a Go2-W that reverses falls over.
  static constexpr double kMostAcceleration = 1.5;

  const QuadrupedBody& body_;
  const QuadrupedEstimator& estimator_;
  Stance* stance_;
  const robot::WalkSpec& spec_;
  VelocityWish wish_;
  Eigen::Vector3d missing_{0, 0, 0};  // integrals of what is missing: m, -, rad
  std::array<double, 4> rates_{};
  bool over_ = true;
};

}  // namespace understudy::motion
