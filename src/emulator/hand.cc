#include "emulator/hand.h"

#include "robot/motor.h"

namespace understudy {

Hand::Hand(const HandSpec& spec, bool lenient)
    : spec_(spec), gate_(spec, lenient), torque_(spec.motors.size()) {}

Refusal Hand::Offer(const HandCommand& command, Refusal wire, double t) {
  const Refusal refusal = gate_.Offer(command, wire, t);
  if (refusal != Refusal::kNone) last_refusal_ = refusal;
  return refusal;
}

std::span<const double> Hand::Step(std::span<const double> q, std::span<const double> dq,
                                   double t) {
  const std::span<const MotorCommand> commands = gate_.Current(t);
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    torque_[i] = AvailableTorque(spec_.motors[i], DesiredTorque(commands[i], q[i], dq[i]), dq[i]);
  }
  return torque_;
}

void Hand::Sample(std::span<const double> q, std::span<const double> dq,
                  HandReading* reading) const {
  reading->motors.resize(torque_.size());
  reading->timed_out.resize(torque_.size());
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    reading->motors[i] = {.enabled = !gate_.locked(i),
                          .q = q[i],
                          .dq = dq[i],
                          .tau = torque_[i],
                          .casing_c = spec_.temperature_c,
                          .winding_c = spec_.temperature_c};
    reading->timed_out[i] = gate_.timed_out(i) ? 1 : 0;
  }
}

}  // namespace understudy
