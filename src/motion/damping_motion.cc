#include "motion/damping_motion.h"

namespace understudy {

MotionVerdict DampingMotion::Ask(const MotionGoal& goal) {
  if (goal.action != MotionAction::kDamp && goal.action != MotionAction::kZeroTorque) {
    return MotionVerdict::kUnable;
  }
  is_limp_ = goal.action == MotionAction::kZeroTorque;
  return MotionVerdict::kTaken;
}

void DampingMotion::Step(const MotionInput&, double, RobotCommand* command) {
  command->joint_space = JointSpace::kPitchRoll;
  const MotorCommand damped{.enabled = true, .q = kNoPosition, .kd = kd_};
  for (MotorCommand& motor : command->motors) motor = is_limp_ ? MotorCommand{} : damped;
}

}  // namespace understudy
