// Getting from any fallen pose onto folded legs.
#ifndef UNDERSTUDY_MOTION_QUADRUPED_RECOVERY_H_
#define UNDERSTUDY_MOTION_QUADRUPED_RECOVERY_H_

#include <cstddef>
#include <cstdint>

#include "motion/joint_move.h"
#include "motion/quadruped/body.h"

namespace understudy::motion {

// Folds the legs; while the robot is not upright, swings legs behind its back, pushes with them and
// folds again: off its back with the legs of the higher side, off its side with those it lies on.
// Should it not get over, it pushes in another way the next time. Looks at joint angles and the
// inertial unit only. Allocates in the constructor only.
class QuadrupedRecovery {
 public:
  // `body` must outlive it.
  explicit QuadrupedRecovery(const QuadrupedBody& body);

  void Begin(const QuadrupedReading& reading);

  // Joint angles [rad] and rates for now.
  void Step(const QuadrupedReading& reading, double dt, PerLeg* q, PerLeg* dq);

  // The robot is upright on folded legs. Before the first Begin: true.
  bool over() const { return phase_ == Phase::kOver; }

 private:
  enum class Phase : std::uint8_t { kFold, kSwing, kPush, kOver };

  void Enter(Phase phase, const QuadrupedReading& reading);
  void Follow(const QuadrupedReading& reading);
  PerLeg Goal(Phase phase) const;

  const QuadrupedBody& body_;
  JointMove move_;
  Phase phase_ = Phase::kOver;
  double left_ = 0;         // s of the phase
  bool on_back_ = false;    // else on its side, as the last push began
  bool right_down_ = true;  // the side that is lower
  std::size_t pushes_ = 0;  // since Begin
};

}  // namespace understudy::motion

#endif  // UNDERSTUDY_MOTION_QUADRUPED_RECOVERY_H_
