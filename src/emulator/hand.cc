#include "emulator/hand.h"

#include "robot/motor.h"

namespace understudy::emulator {

Hand::Hand(const robot::HandSpec& spec) : spec_(spec), torque_(spec.motors.size()) {}

std::span<const double> Hand::Step(const robot::RobotCommand& command, std::span<const double> q,
                                   std::span<const double> dq) {
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    torque_[i] = robot::AvailableTorque(
        spec_.motors[i], robot::DesiredTorque(command.motors[i], q[i], dq[i]), dq[i]);
  }
  return torque_;
}

void Hand::Sample(const authority::HandGate& gate, std::span<const double> q,
                  std::span<const double> dq, robot::HandReading* reading) const {
  reading->motors.resize(torque_.size());
  reading->timed_out.resize(torque_.size());
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    reading->motors[i] = {.enabled = !gate.locked(i),
                          .q = q[i],
                          .dq = dq[i],
                          .tau = torque_[i],
                          .casing_c = spec_.temperature_c,
                          .winding_c = spec_.temperature_c};
    reading->timed_out[i] = gate.timed_out(i) ? 1 : 0;
  }
}

}  // namespace understudy::emulator
