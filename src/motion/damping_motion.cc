#include "motion/damping_motion.h"

namespace understudy::motion {

authority::MotionVerdict DampingMotion::Ask(const authority::MotionGoal& goal) {
  if (std::holds_alternative<authority::goal::Fall>(goal)) {
    return authority::MotionVerdict::kNotNow;  // nothing holds it up
  }
  const auto* fsm = std::get_if<authority::goal::SetFsm>(&goal);
  const bool damp = std::holds_alternative<authority::goal::Damp>(goal) ||
                    (fsm != nullptr && fsm->id == damped_.id);
  const bool limp = std::holds_alternative<authority::goal::ZeroTorque>(goal) ||
                    (fsm != nullptr && fsm->id == limp_.id);
  if (!damp && !limp) return authority::MotionVerdict::kUnable;
  is_limp_ = !damp;
  return authority::MotionVerdict::kTaken;
}

void DampingMotion::Step(const authority::MotionInput&, double, robot::RobotCommand* command) {
  const robot::MotorCommand damped{.enabled = true, .q = robot::kNoPosition, .kd = kd_};
  for (robot::MotorCommand& motor : command->motors)
    motor = is_limp_ ? robot::MotorCommand{} : damped;
}

}  // namespace understudy::motion
