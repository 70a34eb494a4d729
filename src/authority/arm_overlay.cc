#include "authority/arm_overlay.h"

#include <algorithm>
#include <cmath>

#include "authority/command_gate.h"

namespace understudy::authority {
namespace {

// tau + kp (q* - q) + kd (dq* - dq) as constant - kp q - kd dq.
struct Line {
  double constant = 0, kp = 0, kd = 0;
};

Line LineOf(const robot::MotorCommand& command) {
  if (!command.enabled) return {};
  Line line{.constant = command.tau};
  if (command.q != robot::kNoPosition) {
    line.kp = command.kp;
    line.constant += command.kp * command.q;
  }
  if (command.dq != robot::kNoVelocity) {
    line.kd = command.kd;
    line.constant += command.kd * command.dq;
  }
  return line;
}

}  // namespace

robot::MotorCommand Mix(const robot::MotorCommand& under, const robot::MotorCommand& over,
                        double weight) {
  if (weight <= 0) return under;
  if (weight >= 1) return over;
  const Line a = LineOf(under), b = LineOf(over);
  robot::MotorCommand mixed{.enabled = under.enabled || over.enabled};
  mixed.kp = (1 - weight) * a.kp + weight * b.kp;
  mixed.kd = (1 - weight) * a.kd + weight * b.kd;
  mixed.tau = (1 - weight) * a.constant + weight * b.constant;
  return mixed;
}

ArmOverlay::ArmOverlay(const robot::RobotSpec& spec)
    : timeout_(spec.arm_sdk.timeout),
      command_{.motors = std::vector<robot::MotorCommand>(spec.motors.size())} {
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const auto& slots = spec.arm_sdk.slots;
    if (std::find(slots.begin(), slots.end(), spec.motors[i].slot) != slots.end()) {
      motors_.push_back(i);
    }
  }
}

robot::Refusal ArmOverlay::Offer(const robot::RobotCommand& command, double t) {
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
  for (const std::size_t i : motors_) {
    command->motors[i] = Mix(command->motors[i], command_.motors[i], weight);
  }
}

}  // namespace understudy::authority
