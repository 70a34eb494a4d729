#include "emulator/hand.h"

#include "robot/motor.h"

namespace understudy::emulator {

Hand::Hand(const robot::HandSpec& spec, bool lenient)
    : spec_(spec), gate_(spec, lenient), torque_(spec.motors.size()) {}

robot::Refusal Hand::Offer(const robot::HandCommand& command, robot::Refusal wire, double t) {
  const robot::Refusal refusal = gate_.Offer(command, wire, t);
  if (refusal != robot::Refusal::kNone) last_refusal_ = refusal;
  return refusal;
}

std::span<const double> Hand::Step(std::span<const double> q, std::span<const double> dq,
                                   double t) {
  const std::span<const robot::MotorCommand> commands = gate_.Current(t);
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    torque_[i] = robot::AvailableTorque(spec_.motors[i],
                                        robot::DesiredTorque(commands[i], q[i], dq[i]), dq[i]);
  }
  return torque_;
}

void Hand::Sample(std::span<const double> q, std::span<const double> dq,
                  robot::HandReading* reading) const {
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

}  // namespace understudy::emulator
