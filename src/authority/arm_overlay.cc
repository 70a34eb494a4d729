#include "authority/arm_overlay.h"

#include <algorithm>
#include <cmath>

#include "authority/command_gate.h"
#include "robot/motor.h"

namespace understudy::authority {
namespace {

// Sums of gains and of gains times what they pull to, of enabled commands and their weights.
struct Sum {
  double tau = 0, kp = 0, kp_q = 0, kd = 0, kd_dq = 0;

  void Add(const robot::MotorCommand& command, double weight, const std::array<double, 2>& clamp) {
    if (!command.enabled) return;
    tau += weight * command.tau;
    if (command.q != robot::kNoPosition) {
      kp += weight * command.kp;
      kp_q += weight * command.kp * robot::FollowedAngle(command.q, clamp);
    }
    if (command.dq != robot::kNoVelocity) {
      kd += weight * command.kd;
      kd_dq += weight * command.kd * command.dq;
    }
  }
};

}  // namespace

robot::MotorCommand Mix(const robot::MotorCommand& under, const robot::MotorCommand& over,
                        double weight, const std::array<double, 2>& clamp) {
  if (weight <= 0) return under;
  if (weight >= 1) return over;
  Sum sum;
  sum.Add(under, 1 - weight, clamp);
  sum.Add(over, weight, clamp);
  return {.enabled = under.enabled || over.enabled,
          .q = sum.kp > 0 ? sum.kp_q / sum.kp : robot::kNoPosition,
          .dq = sum.kd > 0 ? sum.kd_dq / sum.kd : robot::kNoVelocity,
          .tau = sum.tau,
          .kp = sum.kp,
          .kd = sum.kd};
}

ArmOverlay::ArmOverlay(const robot::RobotSpec& spec)
    : timeout_(spec.arm_sdk.timeout),
      command_{.motors = std::vector<robot::MotorCommand>(spec.motors.size())} {
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const auto& slots = spec.arm_sdk.slots;
    if (std::find(slots.begin(), slots.end(), spec.motors[i].slot) != slots.end()) {
      motors_.push_back({.index = i, .clamp = spec.motors[i].q_clamp});
    }
  }
}

robot::Refusal ArmOverlay::Offer(const robot::RobotCommand& command, double t) {
  if (command.motors.size() != command_.motors.size()) return robot::Refusal::kMotorCount;
  if (!std::isfinite(command.weight)) return robot::Refusal::kNotFinite;
  if (const robot::Refusal harm = HarmIn(command); harm != robot::Refusal::kNone) return harm;
  command_ = command;
  weight_ = std::clamp(command.weight, 0.0, 1.0);
  at_ = t;
  return robot::Refusal::kNone;
}

double ArmOverlay::weight(double t) const {
  return timeout_ > 0 && t - at_ > timeout_ ? 0 : weight_;
}

void ArmOverlay::MixOver(double t, robot::RobotCommand* command) const {
  const double weight = this->weight(t);
  if (weight <= 0) return;
  for (const auto& [i, clamp] : motors_) {
    command->motors[i] = Mix(command->motors[i], command_.motors[i], weight, clamp);
  }
}

}  // namespace understudy::authority
