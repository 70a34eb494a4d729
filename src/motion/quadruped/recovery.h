// Getting from any fallen pose onto folded legs.
#pragma once

#include <cstddef>
#include <cstdint>

#include "motion/quadruped/moves.h"

namespace understudy::motion {

// Folds the legs; while the robot is not upright, swings legs behind its back, pushes with them and
// folds again: off its back with the legs of the higher side, off its side with those it lies on.
// Should it not get over, it pushes in another way the next time. Looks at joint angles and the
// inertial unit only.
class QuadrupedRecovery final : public Behaviour {
 public:
  // `body` must outlive it.
  explicit QuadrupedRecovery(const QuadrupedBody& body) : body_(body) {}

  void Begin(const QuadrupedReading& sensed);
  void Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) override;

  // The robot is upright on folded legs. Before the first Begin: true.
  bool over() const override { return phase_ == Phase::kOver; }

 private:
  enum class Phase : std::uint8_t { kFold, kSwing, kPush, kOver };

  void Enter(Phase phase, const QuadrupedReading& reading);
  void EnterNext(const QuadrupedReading& reading);
  PerLeg Goal(Phase phase) const;

  const QuadrupedBody& body_;
  JointsMove move_;
  Phase phase_ = Phase::kOver;
  double left_ = 0;         // s of the phase
  bool on_back_ = false;    // else on its side, as the last push began
  bool right_down_ = true;  // the side that is lower
  std::size_t pushes_ = 0;  // since Begin
};

}  // namespace understudy::motion
