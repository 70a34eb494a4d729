#include "authority/hand_gate.h"

namespace understudy::authority {
namespace {

robot::Refusal FirstHarm(const robot::HandCommand& command) {
  for (const robot::HandMotorCommand& asked : command.motors) {
    if (const robot::Refusal harm = HarmIn(asked.motor); harm != robot::Refusal::kNone) return harm;
  }
  return robot::Refusal::kNone;
}

}  // namespace

HandGate::HandGate(const robot::HandSpec& spec, bool lenient)
    : spec_(spec), lenient_(lenient), motors_(spec.motors.size()), current_(spec.motors.size()) {
  Restart();
}

robot::Refusal HandGate::Offer(const robot::HandCommand& command, robot::Refusal wire, double t) {
  const bool fits = wire != robot::Refusal::kMotorCount && command.motors.size() == motors_.size();
  if (!fits) wire = robot::Refusal::kMotorCount;
  if (wire != robot::Refusal::kNone) ++counts_.refused[static_cast<std::size_t>(wire)];
  if (wire != robot::Refusal::kNone && (!lenient_ || !fits)) return wire;
  if (const robot::Refusal harm = FirstHarm(command); harm != robot::Refusal::kNone) {
    ++counts_.refused[static_cast<std::size_t>(harm)];
    return harm;
  }
  ++counts_.accepted;
  taken_at_ = t;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const robot::HandMotorCommand& asked = command.motors[i];
    motors_[i].watched = asked.watched;
    if (!asked.watched) motors_[i].timed_out = false;
    if (motors_[i].timed_out || !asked.motor.enabled) {
      Lock(i);
    } else {
      motors_[i].locked = false;
      current_[i] = asked.motor;
    }
  }
  return robot::Refusal::kNone;
}

std::span<const robot::MotorCommand> HandGate::Current(double t) {
  if (t - taken_at_ <= spec_.timeout) return current_;
  bool stopped = false;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    Motor& motor = motors_[i];
    if (!motor.watched || motor.timed_out) continue;
    motor.timed_out = stopped = true;
    Lock(i);
  }
  if (stopped) ++counts_.timeouts;
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
  current_[motor] = {.enabled = true, .q = robot::kNoPosition, .kd = spec_.lock_kd};
}

}  // namespace understudy::authority
