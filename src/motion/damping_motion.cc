#include "motion/damping_motion.h"

namespace understudy {

MotionVerdict DampingMotion::Ask(const MotionGoal& goal) {
  const bool by_id = goal.action == MotionAction::kSetFsm;
  const bool damp = goal.action == MotionAction::kDamp || (by_id && goal.value[0] == damped_.id);
  const bool limp =
      goal.action == MotionAction::kZeroTorque || (by_id && goal.value[0] == limp_.id);
  if (!damp && !limp) return MotionVerdict::kUnable;
  is_limp_ = !damp;
  return MotionVerdict::kTaken;
}

void DampingMotion::Step(const MotionInput&, double, RobotCommand* command) {
  command->joint_space = JointSpace::kPitchRoll;
  const MotorCommand damped{.enabled = true, .q = kNoPosition, .kd = kd_};
  for (MotorCommand& motor : command->motors) motor = is_limp_ ? MotorCommand{} : damped;
}

}  // namespace understudy
