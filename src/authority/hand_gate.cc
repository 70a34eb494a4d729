#include "authority/hand_gate.h"

namespace understudy::authority {

HandGate::HandGate(const robot::HandSpec& spec)
    : timeout_(spec.timeout),
      lock_kd_(spec.lock_kd),
      motors_(spec.motors.size()),
      current_{.motors = std::vector<robot::MotorCommand>(spec.motors.size())} {
  Restart();
}

robot::Refusal HandGate::Offer(const robot::RobotCommand& command, double t) {
  if (command.motors.size() != motors_.size()) return robot::Refusal::kMotorCount;
  if (const robot::Refusal harm = HarmIn(command); harm != robot::Refusal::kNone) return harm;
  taken_at_ = t;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const robot::MotorCommand& asked = command.motors[i];
    motors_[i].watched = asked.watched;
    if (!asked.watched) motors_[i].timed_out = false;
    if (motors_[i].timed_out || !asked.enabled) {
      Lock(i);
    } else {
      motors_[i].locked = false;
      current_.motors[i] = asked;
    }
  }
  return robot::Refusal::kNone;
}

const robot::RobotCommand& HandGate::Current(double t) {
  if (t - taken_at_ <= timeout_) return current_;
  bool stopped = false;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    Motor& motor = motors_[i];
    if (!motor.watched || motor.timed_out) continue;
    motor.timed_out = stopped = true;
    Lock(i);
  }
  if (stopped) ++timeouts_;
  return current_;
}

void HandGate::Restart() {
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    motors_[i] = {};
    Lock(i);
  }
}

void HandGate::Lock(std::size_t motor) {
  motors_[motor].locked = true;
  current_.motors[motor] = {.enabled = true, .q = robot::kNoPosition, .kd = lock_kd_};
}

}  // namespace understudy::authority
