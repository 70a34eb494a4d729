#include "authority/hand_gate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace understudy::authority {

HandGate::HandGate(const robot::HandSpec& spec)
    : law_(&robot::LawOf(spec)),
      timeout_(spec.timeout),
      current_{.motors = std::vector<robot::MotorCommand>(spec.motors.size())} {
  if (law_->follows == robot::HandLaw::Follows::kMotors) return;
  for (const robot::MotorSpec& motor : spec.motors) {
    leads_.push_back({.start = {.enabled = law_->starts, .kp = motor.hold_kp, .kd = motor.hold_kd},
                      .full_speed = motor.knee_speed,
                      .set_speed = motor.knee_speed});
    if (law_->starts) leads_.back().start.q = motor.span[0];
  }
  Restart();
}

robot::Refusal HandGate::Offer(const robot::RobotCommand& command, double t) {
  if (command.motors.size() != current_.motors.size()) return robot::Refusal::kMotorCount;
  if (const robot::Refusal harm = HarmIn(command); harm != robot::Refusal::kNone) return harm;
  FollowGoals(t);
  taken_at_ = t;
  for (std::size_t i = 0; i < leads_.size(); ++i) {
    Lead& lead = leads_[i];
    const robot::MotorCommand& motor = command.motors[i];
    lead.from = current_.motors[i].q;
    if (law_->follows == robot::HandLaw::Follows::kRegisters) {
      SetRegisters(motor, &lead, &current_.motors[i]);
      continue;
    }
    const bool paced = law_->follows == robot::HandLaw::Follows::kGoalsAtSpeed;
    lead.goal = motor.q;
    lead.speed = paced ? std::clamp(motor.dq, 0.0, lead.full_speed) : lead.full_speed;
    current_.motors[i].enabled = true;
  }
  for (std::size_t i = 0; leads_.empty() && i < current_.motors.size(); ++i) {
    current_.motors[i] = command.motors[i];
    current_.motors[i].timed_out = false;
  }
  return robot::Refusal::kNone;
}

void HandGate::SetRegisters(const robot::MotorCommand& command, Lead* lead,
                            robot::MotorCommand* followed) {
  if (command.dq != robot::kNoVelocity)
    lead->set_speed = std::clamp(command.dq, 0.0, lead->full_speed);
  if (command.tau >= 0) followed->most = command.tau;
  lead->speed = lead->set_speed;
  if (command.q == robot::kNoPosition) return;
  lead->goal = command.q;
  followed->enabled = true;
}

void HandGate::FollowGoals(double t) {
  for (std::size_t i = 0; i < leads_.size(); ++i) {
    const Lead& lead = leads_[i];
    const double way = lead.speed * (t - taken_at_);
    const double left = lead.goal - lead.from;
    robot::MotorCommand& motor = current_.motors[i];
    motor.q = lead.from + std::clamp(left, -way, way);
    motor.dq = std::abs(left) > way ? std::copysign(lead.speed, left) : 0;
  }
}

const robot::RobotCommand& HandGate::Current(double t) {
  FollowGoals(t);
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

void HandGate::SetRunning(bool runs, double t) {
  const bool starts = runs && !runs_;
  runs_ = runs;
  if (!starts) return;
  FollowGoals(t);
  if (law_->watched) std::ranges::fill(current_.motors, robot::MotorCommand{});
  if (!law_->starts) return;
  taken_at_ = t;
  for (std::size_t i = 0; i < leads_.size(); ++i) {
    Lead& lead = leads_[i];
    lead.from = current_.motors[i].q;
    lead.goal = lead.start.q;
    lead.speed = lead.full_speed;
  }
}

void HandGate::Restart() {
  std::ranges::fill(current_.motors, robot::MotorCommand{});
  for (std::size_t i = 0; i < leads_.size(); ++i) {
    Lead& lead = leads_[i];
    current_.motors[i] = lead.start;
    lead.from = lead.goal = lead.start.q;
    lead.speed = 0;
    lead.set_speed = lead.full_speed;
  }
}

}  // namespace understudy::authority
