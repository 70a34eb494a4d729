// Legs on their way from one posture to another.
#pragma once

#include "motion/joint_move.h"
#include "motion/quadruped/behaviour.h"

namespace understudy::motion {

// All joints go to given angles and carry nothing.
class JointsMove final : public Behaviour {
 public:
  // To the angles `to` [rad] in `duration` s, or as fast as a robot moves that nobody hurries.
  void Begin(const QuadrupedReading& sensed, const PerLeg& to, double duration);
  void Begin(const QuadrupedReading& sensed, const PerLeg& to);
  void Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) override;
  bool over() const override { return move_.over(); }

 private:
  JointMove move_{12};
};

// The feet go straight to points in the base, while they take over the robot's weight or give it
// up.
class FeetMove final : public Behaviour {
 public:
  enum class Load : std::uint8_t { kTaken, kGivenUp };

  // `body` must outlive it.
  explicit FeetMove(const QuadrupedBody& body) : body_(body) {}

  void Begin(const QuadrupedReading& sensed, const PerLeg& to, Load load);  // `to`: m, in the base
  void Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) override;
  bool over() const override;

 private:
  const QuadrupedBody& body_;
  PerLeg from_, to_;
  Load load_ = Load::kTaken;
  double elapsed_ = 0;  // s
};

}  // namespace understudy::motion
