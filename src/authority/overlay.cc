#include "authority/overlay.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

Overlay::Overlay(std::vector<Motor> motors, std::size_t count, double timeout)
    : motors_(std::move(motors)),
      timeout_(timeout),
      command_{.motors = std::vector<robot::MotorCommand>(count)} {}

robot::Refusal Overlay::Offer(const robot::RobotCommand& command, double t) {
  if (command.motors.size() != command_.motors.size()) return robot::Refusal::kMotorCount;
  if (!std::isfinite(command.weight)) return robot::Refusal::kNotFinite;
  if (const robot::Refusal harm = HarmIn(command); harm != robot::Refusal::kNone) return harm;
  command_ = command;
  weight_ = std::clamp(command.weight, 0.0, 1.0);
  at_ = t;
  return robot::Refusal::kNone;
}

double Overlay::weight(double t) const { return timeout_ > 0 && t - at_ > timeout_ ? 0 : weight_; }

void Overlay::MixOver(double t, std::span<robot::MotorCommand> motors) const {
  const double weight = this->weight(t);
  if (weight <= 0) return;
  for (const auto& [i, clamp, lock_kd] : motors_) {
    const robot::MotorCommand under = motors[i].enabled ? motors[i] : robot::Locked(lock_kd);
    motors[i] = Mix(under, command_.motors[i], weight, clamp);
  }
}

Overlay OverArms(const robot::RobotSpec& spec) {
  std::vector<Overlay::Motor> motors;
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const auto& slots = spec.arm_sdk.slots;
    if (std::ranges::find(slots, spec.motors[i].slot) == slots.end()) continue;
    motors.push_back({.index = i, .clamp = spec.motors[i].q_clamp});
  }
  return {std::move(motors), spec.motors.size(), spec.arm_sdk.timeout};
}

Overlay OverHands(const robot::RobotSpec& spec) {
  std::vector<Overlay::Motor> motors;
  std::size_t count = 0;
  for (const robot::HandSpec& hand : spec.hands) {
    for (const robot::MotorSpec& motor : hand.motors) {
      if (hand.sdk_slot >= 0) motors.push_back({.index = count, .lock_kd = motor.lock_kd});
      ++count;
    }
  }
  return {std::move(motors), count, spec.hand_sdk_timeout};
}

}  // namespace understudy::authority
