// Getting from any fallen pose onto folded legs.
#ifndef UNDERSTUDY_MOTION_QUADRUPED_RECOVERY_H_
#define UNDERSTUDY_MOTION_QUADRUPED_RECOVERY_H_

#include <cstdint>

#include "motion/joint_move.h"
#include "motion/quadruped_body.h"

namespace understudy {

// Folds the legs; while the robot is not upright, pushes it over with the legs of one side and
// folds again. Looks at joint angles and the inertial unit only. Allocates in the constructor
// only.
class QuadrupedRecovery {
 public:
  // `body` must outlive it.
  explicit QuadrupedRecovery(const QuadrupedBody& body);

  void Begin(const QuadrupedReading& reading);

  // Joint angles and rates for now.
  void Step(const QuadrupedReading& reading, double dt, PerLeg* q, PerLeg* dq);

  // The robot is upright on folded legs.
  bool over() const { return phase_ == Phase::kOver; }

 private:
  enum class Phase : std::uint8_t { kFold, kFromBack, kFromSide, kOver };

  void Enter(Phase phase, const QuadrupedReading& reading);
  PerLeg Goal(Phase phase) const;

  const QuadrupedBody& body_;
  JointMove move_;
  Phase phase_ = Phase::kOver;
  double left_ = 0;         // s of the phase
  bool right_down_ = true;  // the side it lies on or is rolled to
  int attempts_ = 0;
};

}  // namespace understudy

#endif  // UNDERSTUDY_MOTION_QUADRUPED_RECOVERY_H_
