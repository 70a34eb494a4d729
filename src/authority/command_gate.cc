#include "authority/command_gate.h"

#include <cmath>
#include <utility>

namespace understudy::authority {
// Values that no program can intend. That a robot refuses them too is assumed, as it is not
// documented.
robot::Refusal HarmIn(const robot::MotorCommand& m) {
  if (!std::isfinite(m.q) || !std::isfinite(m.dq) || !std::isfinite(m.tau) ||
      !std::isfinite(m.kp) || !std::isfinite(m.kd)) {
    return robot::Refusal::kNotFinite;
  }
  return m.kp < 0 || m.kd < 0 ? robot::Refusal::kGain : robot::Refusal::kNone;
}

robot::Refusal HarmIn(const robot::RobotCommand& command) {
  for (const robot::MotorCommand& motor : command.motors) {
    if (const robot::Refusal harm = HarmIn(motor); harm != robot::Refusal::kNone) return harm;
  }
  return robot::Refusal::kNone;
}

robot::RobotCommand DampingCommand(std::size_t motors, double kd) {
  robot::RobotCommand command;
  command.motors.assign(motors,
                        robot::MotorCommand{.enabled = true, .q = robot::kNoPosition, .kd = kd});
  return command;
}

CommandGate::CommandGate(const GateConfig& config, robot::RobotCommand start)
    : config_(config),
      start_(std::move(start)),
      taken_(start_),
      damping_(DampingCommand(start_.motors.size(), config.damping_kd)),
      limp_{.motors = std::vector<robot::MotorCommand>(start_.motors.size())} {}

robot::Refusal CommandGate::Offer(const robot::RobotCommand& command, double t) {
  if (command.motors.size() != start_.motors.size()) return robot::Refusal::kMotorCount;
  if (const robot::Refusal harm = HarmIn(command); harm != robot::Refusal::kNone) return harm;
  if (state_ == GateState::kClosed) return robot::Refusal::kMotionService;
  taken_ = command;
  taken_at_ = t;
  state_ = GateState::kFollowing;
  return robot::Refusal::kNone;
}

const robot::RobotCommand& CommandGate::Current(double t) {
  if (state_ == GateState::kFollowing && t - taken_at_ > config_.timeout) {
    state_ = GateState::kDamping;
    ++timeouts_;
  }
  switch (state_) {
    case GateState::kFollowing:
      return taken_;
    case GateState::kDamping:
    case GateState::kClosed:
      return damping_;
    case GateState::kLimp:
      return limp_;
    case GateState::kStart:
      break;
  }
  return start_;
}

void CommandGate::Restart() { state_ = GateState::kStart; }

void CommandGate::Restart(const robot::RobotCommand& start) {
  start_ = start;
  Restart();
}

}  // namespace understudy::authority
