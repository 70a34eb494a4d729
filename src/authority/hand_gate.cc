#include "authority/hand_gate.h"

namespace understudy {
namespace {

Refusal FirstHarm(const HandCommand& command) {
  for (const HandMotorCommand& asked : command.motors) {
    if (const Refusal harm = HarmIn(asked.motor); harm != Refusal::kNone) return harm;
  }
  return Refusal::kNone;
}

}  // namespace

HandGate::HandGate(const HandSpec& spec, bool lenient)
    : spec_(spec), lenient_(lenient), motors_(spec.motors.size()), current_(spec.motors.size()) {
  Restart();
}

Refusal HandGate::Offer(const HandCommand& command, Refusal wire, double t) {
  const bool fits = wire != Refusal::kMotorCount && command.motors.size() == motors_.size();
  if (!fits) wire = Refusal::kMotorCount;
  if (wire != Refusal::kNone) ++counts_.refused[static_cast<std::size_t>(wire)];
  if (wire != Refusal::kNone && (!lenient_ || !fits)) return wire;
  if (const Refusal harm = FirstHarm(command); harm != Refusal::kNone) {
    ++counts_.refused[static_cast<std::size_t>(harm)];
    return harm;
  }
  ++counts_.accepted;
  taken_at_ = t;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const HandMotorCommand& asked = command.motors[i];
    motors_[i].watched = asked.watched;
    if (!asked.watched) motors_[i].timed_out = false;
    if (motors_[i].timed_out || !asked.motor.enabled) {
      Lock(i);
    } else {
      motors_[i].locked = false;
      current_[i] = asked.motor;
    }
  }
  return Refusal::kNone;
}

std::span<const MotorCommand> HandGate::Current(double t) {
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
  current_[motor] = {.enabled = true, .q = kNoPosition, .kd = spec_.lock_kd};
}

}  // namespace understudy
