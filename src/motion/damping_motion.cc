#include "motion/damping_motion.h"

namespace understudy::motion {

authority::MotionVerdict DampingMotion::Ask(const authority::MotionGoal& goal) {
  const bool by_id = goal.action == authority::MotionAction::kSetFsm;
  const bool damp =
      goal.action == authority::MotionAction::kDamp || (by_id && goal.value[0] == damped_.id);
  const bool limp =
      goal.action == authority::MotionAction::kZeroTorque || (by_id && goal.value[0] == limp_.id);
  if (!damp && !limp) return authority::MotionVerdict::kUnable;
  is_limp_ = !damp;
  return authority::MotionVerdict::kTaken;
}

void DampingMotion::Step(const authority::MotionInput&, double, robot::RobotCommand* command) {
  command->joint_space = robot::JointSpace::kPitchRoll;
  const robot::MotorCommand damped{.enabled = true, .q = robot::kNoPosition, .kd = kd_};
  for (robot::MotorCommand& motor : command->motors)
    motor = is_limp_ ? robot::MotorCommand{} : damped;
}

}  // namespace understudy::motion
