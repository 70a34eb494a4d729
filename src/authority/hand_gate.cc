#include "authority/hand_gate.h"

#include <algorithm>

namespace understudy::authority {

HandGate::HandGate(const robot::HandSpec& spec)
    : timeout_(spec.timeout),
      current_{.motors = std::vector<robot::MotorCommand>(spec.motors.size())} {}

robot::Refusal HandGate::Offer(const robot::RobotCommand& command, double t) {
  if (command.motors.size() != current_.motors.size()) return robot::Refusal::kMotorCount;
  if (const robot::Refusal harm = HarmIn(command); harm != robot::Refusal::kNone) return harm;
  taken_at_ = t;
  for (std::size_t i = 0; i < current_.motors.size(); ++i) {
    robot::MotorCommand& motor = current_.motors[i];
    const bool timed_out = motor.timed_out && command.motors[i].watched;
    motor = command.motors[i];
    motor.timed_out = timed_out;
    if (timed_out) motor.enabled = false;
  }
  return robot::Refusal::kNone;
}

const robot::RobotCommand& HandGate::Current(double t) {
  if (t - taken_at_ <= timeout_) return current_;
  bool stopped = false;
  for (robot::MotorCommand& motor : current_.motors) {
    if (!motor.watched || motor.timed_out) continue;
    motor.timed_out = stopped = true;
    motor.enabled = false;
  }
  if (stopped) ++timeouts_;
  return current_;
}

void HandGate::Restart() { std::ranges::fill(current_.motors, robot::MotorCommand{}); }

}  // namespace understudy::authority
