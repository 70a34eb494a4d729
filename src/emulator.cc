#include "emulator.h"

#include <cmath>
#include <utility>

namespace understudy {
namespace {

// What holds `q` against gravity with the gains the robot's description names.
RobotCommand HoldCommand(const RobotSpec& spec, const std::vector<double>& q) {
  RobotCommand command;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const MotorSpec& motor = spec.motors[i];
    command.motors.push_back(
        {.enabled = true, .q = q[i], .kp = motor.hold_kp, .kd = motor.hold_kd});
  }
  return command;
}

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace

Emulator::Emulator(const Config& config, PhysicsWorld world, RobotPort* port, Inbox* inbox)
    : config_(config),
      start_(StartOf(config_)),
      world_(std::move(world)),
      port_(port),
      inbox_(inbox),
      motors_(config_.robot),
      battery_(config_.robot.battery),
      sensors_(config_.sensors, config_.robot),
      crane_(config_.crane),
      gate_(config_.gate, start_.command),
      crane_body_(world_.Body(config_.robot.crane_body)),
      crane_point_(config_.robot.crane_point.data()),
      step_ns_(std::llround(config_.physics.timestep * 1e9)),
      lowstate_every_(Every(config_.robot.rates.lowstate_hz)),
      motion_every_(Every(config_.robot.rates.motion_hz)),
      lf_every_(Every(config_.robot.rates.lf_hz)),
      offered_(start_.command) {
  ToStart();
}

StepHealth Emulator::Tick() {
  const double t = time();
  inbox_->Drain([this](const Order& order) { return CarryOut(order); });
  for (Refusal wire = Refusal::kNone; port_->TakeCommand(&offered_, &wire);) {
    const Refusal refusal = gate_.Offer(offered_, wire, t);
    if (refusal != Refusal::kNone) last_refusal_ = refusal;
  }
  const RobotCommand& command = gate_.Current(t);

  world_.BeginStep();
  motors_.Step(command, world_.q(), world_.dq(), world_.timestep());
  PullCrane();
  const StepHealth health = world_.EndStep(motors_.torque());
  battery_.Step(motors_.torque(), world_.dq(), world_.timestep());

  if (health == StepHealth::kDiverged) {
    ++divergences_;
    if (config_.physics.on_divergence == DivergenceAction::kReset) ToStart();
  } else if (const Due due = DueNow(); due.any()) {
    sensors_.Sample(world_, motors_, command, battery_, step_ * step_ns_ / 1'000'000, &state_);
    if (!silenced_) {
      port_->Publish(state_, due);
      if (due.lowstate) ++published_;
    }
  }
  ++step_;
  return health;
}

Status Emulator::status() const {
  Status status;
  status.silenced = silenced_;
  status.time = time();
  status.steps = step_;
  status.gate = gate_.state();
  status.commands = gate_.counts();
  status.last_refusal = last_refusal_;
  status.port = port_->counts();
  status.published = published_;
  status.divergences = divergences_;
  status.crane_attached = crane_.attached();
  status.crane_length = crane_.length();
  status.crane_tension = crane_.tension();
  status.clamped = world_.clamped();
  status.base_height = world_.base().p_WB.z();
  status.tilt = world_.tilt();
  return status;
}

Emulator::Start Emulator::StartOf(const Config& config) {
  const RobotSpec& robot = config.robot;
  const std::string& name = config.start.pose.empty() ? robot.default_start : config.start.pose;
  const RobotCommand damping = DampingCommand(robot.motors.size(), config.gate.damping_kd);
  if (name == "standing") {
    return {.command = HoldCommand(robot, robot.standing.q), .pose = robot.standing};
  }
  if (name == "hanging") return {.command = damping, .pose = robot.hanging, .on_crane = true};
  if (name == "clamped") return {.command = damping, .pose = robot.hanging, .clamped = true};
  return {.command = damping, .pose = robot.lying};
}

std::int64_t Emulator::Every(double hz) const {
  return std::llround(1e9 / (hz * static_cast<double>(step_ns_)));
}

void Emulator::ToStart() {
  gate_.Restart();
  world_.Reset(start_.pose);
  crane_.Release();
  if (start_.on_crane) HangFromCrane();
  world_.Clamp(start_.clamped);
}

Due Emulator::DueNow() const {
  return {.lowstate = step_ % lowstate_every_ == 0,
          .motion = step_ % motion_every_ == 0,
          .lf = step_ % lf_every_ == 0};
}

void Emulator::PullCrane() {
  if (!crane_.attached()) return;
  const PointReading hook = world_.Point(crane_body_, crane_point_);
  world_.AddForce(crane_body_, hook.p_WP, crane_.Step(hook, world_.timestep()));
}

void Emulator::HangFromCrane() {
  crane_.Attach(world_.Point(crane_body_, crane_point_).p_WP, world_.weight());
}

Answer Emulator::CarryOut(const Order& order) {
  return std::visit(Overloaded{
                        [this](const LowerCrane& lower) -> Answer {
                          if (!crane_.attached()) return "the robot does not hang from the crane";
                          crane_.Lower(lower.by);
                          return {};
                        },
                        [this](const AttachCrane&) -> Answer {
                          HangFromCrane();
                          return {};
                        },
                        [this](const ReleaseCrane&) -> Answer {
                          crane_.Release();
                          return {};
                        },
                        [this](const ClampBase& clamp) -> Answer {
                          world_.Clamp(clamp.on);
                          return {};
                        },
                        [this](const ResetRobot&) -> Answer {
                          ToStart();
                          return {};
                        },
                    },
                    order);
}

}  // namespace understudy
