#include "motion/humanoid/postures.h"

namespace understudy::motion {

void Slack::Step(const HumanoidReading& sensed, double, robot::RobotCommand* command) {
  bearing_->CarryWeight(sensed);
  for (std::size_t i = 0; i < gains_.kd.size(); ++i) {
    command->motors[i] = {.enabled = true, .kd = limp_ ? 0 : gains_.kd[i]};
  }
}

void LockedPosture::Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) {
  bearing_->CarryWeight(sensed);
  move_.Advance(dt);
  for (std::size_t i = 0; i < gains_.kp.size(); ++i) {
    command->motors[i] = {.enabled = true,
                          .q = move_.q(i),
                          .dq = move_.dq(i),
                          .tau = bearing_->tau(i),
                          .kp = gains_.kp[i],
                          .kd = gains_.kd[i]};
  }
}

}  // namespace understudy::motion
