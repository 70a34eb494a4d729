#include "motion/humanoid/fsm.h"

#include <algorithm>

namespace understudy::motion {
namespace {

bool Has(const std::vector<int>& ids, int id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

HumanoidStance StanceOf(const robot::HumanoidMotionSpec& spec, int id) {
  if (id == kZeroTorqueId) return HumanoidStance::kZeroTorque;
  if (id == kDampingId) return HumanoidStance::kDamping;
  if (id < 0) return HumanoidStance::kNone;
  if (id == spec.lock_stand || id == spec.squat || id == spec.sit) return HumanoidStance::kLocked;
  if (id == spec.balanced_squat || Has(spec.balance, id)) return HumanoidStance::kBalanced;
  return Has(spec.unplayed, id) ? HumanoidStance::kUnplayed : HumanoidStance::kNone;
}

authority::MotionVerdict MayGo(const robot::HumanoidMotionSpec& spec, int from, int to,
                               bool moving) {
  const HumanoidStance stance = StanceOf(spec, from);
  const HumanoidStance wanted = StanceOf(spec, to);
  if (wanted == HumanoidStance::kNone) return authority::MotionVerdict::kUnknown;
  if (wanted == HumanoidStance::kDamping) return authority::MotionVerdict::kTaken;
  const auto taken_if = [](bool legal) {
    return legal ? authority::MotionVerdict::kTaken : authority::MotionVerdict::kNotNow;
  };
  if (wanted == HumanoidStance::kZeroTorque) return authority::MotionVerdict::kTaken;
  if (stance == HumanoidStance::kZeroTorque) return authority::MotionVerdict::kNotNow;
  if (to == from && to != spec.balanced_squat) return authority::MotionVerdict::kTaken;
  if (moving) return authority::MotionVerdict::kNotNow;
  if (wanted == HumanoidStance::kUnplayed) return authority::MotionVerdict::kUnable;
  if (to == spec.balanced_squat) {
    // From damping the robot would have to rise from where it squats on the ground.
    if (stance == HumanoidStance::kDamping) return authority::MotionVerdict::kUnable;
    return taken_if(stance == HumanoidStance::kBalanced);
  }
  if (wanted == HumanoidStance::kBalanced) {
    return taken_if(from == spec.lock_stand ||
                    (stance == HumanoidStance::kBalanced && from != spec.balanced_squat));
  }
  // Locked: no arrow leads from balancing back to standing locked, or out of the balanced squat.
  if (from == spec.balanced_squat) return authority::MotionVerdict::kNotNow;
  return taken_if(to != spec.lock_stand || stance != HumanoidStance::kBalanced);
}

}  // namespace understudy::motion
