#include "authority/command_gate.h"

#include <cmath>
#include <utility>

namespace understudy {
// What no program can mean. That a robot refuses it too is assumed: nothing is published.
Refusal HarmIn(const MotorCommand& m) {
  if (!std::isfinite(m.q) || !std::isfinite(m.dq) || !std::isfinite(m.tau) ||
      !std::isfinite(m.kp) || !std::isfinite(m.kd)) {
    return Refusal::kNotFinite;
  }
  return m.kp < 0 || m.kd < 0 ? Refusal::kGain : Refusal::kNone;
}

Refusal HarmIn(const RobotCommand& command) {
  for (const MotorCommand& motor : command.motors) {
    if (const Refusal harm = HarmIn(motor); harm != Refusal::kNone) return harm;
  }
  return Refusal::kNone;
}

RobotCommand DampingCommand(std::size_t motors, double kd) {
  RobotCommand command;
  command.motors.assign(motors, MotorCommand{.enabled = true, .q = kNoPosition, .kd = kd});
  return command;
}

CommandGate::CommandGate(const GateConfig& config, RobotCommand start)
    : config_(config),
      start_(std::move(start)),
      taken_(start_),
      damping_(DampingCommand(start_.motors.size(), config.damping_kd)),
      limp_{.motors = std::vector<MotorCommand>(start_.motors.size())} {}

Refusal CommandGate::Offer(const RobotCommand& command, Refusal wire, double t) {
  const Refusal harm = HarmIn(command);
  if (wire != Refusal::kNone) ++counts_.refused[static_cast<std::size_t>(wire)];
  if (wire != Refusal::kNone && !config_.lenient) return wire;
  if (harm != Refusal::kNone) {
    ++counts_.refused[static_cast<std::size_t>(harm)];
    return harm;
  }
  if (state_ == GateState::kClosed) {
    ++counts_.refused[static_cast<std::size_t>(Refusal::kMotionService)];
    return Refusal::kMotionService;
  }
  ++counts_.accepted;
  taken_ = command;
  taken_at_ = t;
  state_ = GateState::kFollowing;
  return Refusal::kNone;
}

const RobotCommand& CommandGate::Current(double t) {
  if (state_ == GateState::kFollowing && t - taken_at_ > config_.timeout) {
    state_ = GateState::kDamping;
    ++counts_.timeouts;
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

void CommandGate::Restart(const RobotCommand& start) {
  start_ = start;
  Restart();
}

}  // namespace understudy
