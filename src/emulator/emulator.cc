#include "emulator/emulator.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "motion/make_motion.h"

namespace understudy::emulator {
namespace {

// What holds `q` against gravity with the gains the robot's description names.
robot::RobotCommand HoldCommand(const robot::RobotSpec& spec, const std::vector<double>& q) {
  robot::RobotCommand command;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const robot::MotorSpec& motor = spec.motors[i];
    command.motors.push_back(
        {.enabled = true, .q = q[i], .kp = motor.hold_kp, .kd = motor.hold_kd});
  }
  return command;
}

std::size_t DelaySteps(const config::Config& config) {
  return static_cast<std::size_t>(
      std::llround(config.robot.dynamics.delay / config.physics.timestep));
}

// Validated, so it is one.
robot::StartPose StartPoseOf(const config::Config& config) {
  const std::string& word =
      config.start.pose.empty() ? config.robot.default_start : config.start.pose;
  return robot::FindStartPose(word).value_or(robot::StartPose::kLying);
}

// Cut to what there is room for, with a zero at the end.
template <std::size_t kRoom>
void Copy(std::string_view text, std::array<char, kRoom>* to) {
  *std::copy_n(text.begin(), std::min(text.size(), kRoom - 1), to->begin()) = '\0';
}

}  // namespace

Emulator::Emulator(const config::Config& config, physics::PhysicsWorld world, wire::RobotPort* port,
                   Inbox* inbox)
    : config_(config),
      start_pose_(StartPoseOf(config_)),
      starts_(StartsOf(config_)),
      world_(std::move(world)),
      port_(port),
      inbox_(inbox),
      delay_(DelaySteps(config_), start().command),
      motors_(config_.robot),
      battery_(config_.robot.battery),
      sensors_(config_.sensors, config_.robot),
      crane_(config_.crane),
      router_(config_.robot, config_.gate, config_.motion, start().command,
              motion::MakeMotion(config_.robot, world_, config_.gate.damping_kd)),
      crane_body_(world_.Body(config_.robot.crane_body)),
      crane_point_(config_.robot.crane_point.data()),
      step_ns_(std::llround(config_.physics.timestep * 1e9)),
      lowstate_every_(Every(config_.robot.rates.lowstate_hz)),
      motion_every_(Every(config_.robot.rates.motion_hz)),
      hand_every_(Every(config_.robot.rates.hand_hz)),
      lf_every_(Every(config_.robot.rates.lf_hz)),
      service_every_(Every(config_.robot.rates.service_hz)),
      pace_{.speed = config_.time.speed},
      command_(&start().command),
      offered_(start().command) {
  for (const robot::HandSpec& hand : config_.robot.hands)
    hands_.emplace_back(hand, config_.gate.lenient);
  state_.hands.resize(hands_.size());
  To(start());
}

physics::StepHealth Emulator::Tick() {
  const double t = time();
  FollowScript(t);
  TakeOrders();
  TakeCommands(t);
  TakeHandCommands(t);
  command_ = &delay_.Pass(Decide(t));

  world_.BeginStep();
  motors_.Step(*command_, world_.q(), world_.dq(), world_.timestep());
  MoveHands(t);
  PushAndPull(t);
  const physics::StepHealth health = world_.EndStep(motors_.torque());
  battery_.Step(motors_.torque(), world_.dq(), world_.timestep());

  if (health == physics::StepHealth::kDiverged) {
    ++divergences_;
    if (config_.physics.on_divergence == config::DivergenceAction::kReset) To(start());
  } else if (const wire::Due due = DueNow(); due.any()) {
    Sample(step_);
    if (!silenced_) {
      port_->Publish(state_, due);
      if (due.lowstate) ++published_;
    }
  }
  ++step_;
  if (pace_.steps_left > 0) --pace_.steps_left;
  return health;
}

void Emulator::TakeCommands(double t) {
  router_.Obey(remote_.Read(t), t);
  double weight = 0;
  while (port_->TakeArmCommand(&offered_, &weight)) {
    refusals_.Add(robot::kArmSdkTopic, router_.OfferArms(offered_, weight, t), t);
  }
  while (port_->TakeUserCommand(&offered_)) {
    refusals_.Add(robot::kUserLowCmdTopic, router_.OfferUser(offered_, t), t);
  }
  for (robot::Refusal wire = robot::Refusal::kNone; port_->TakeCommand(&offered_, &wire);) {
    const robot::Refusal refusal = router_.Offer(offered_, wire, t);
    if (refusal != robot::Refusal::kNone) last_refusal_ = refusal;
    refusals_.Add(robot::kLowCmdTopic, refusal, t);
  }
}

void Emulator::TakeHandCommands(double t) {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    for (robot::Refusal wire = robot::Refusal::kNone;
         port_->TakeHandCommand(i, &offered_hand_, &wire);) {
      refusals_.Add(robot::kFirstHandTopic + i, hands_[i].Offer(offered_hand_, wire, t), t);
    }
  }
}

// All that a motion service knows is what the sensors said of the step before, as a robot's own
// computer has it: the published sample where there was one. While no service is on nothing is
// sampled for it.
const robot::RobotCommand& Emulator::Decide(double t) {
  const bool service_due = step_ % service_every_ == 0;
  input_.time = t;
  if (service_due && router_.service_on()) {
    if (sampled_ != step_ - 1) Sample(step_ - 1);
    input_.motors = state_.motors;
    input_.imu = state_.imu;
    input_.foot_force = state_.foot_force;
  }
  return router_.Current(input_, service_due,
                         static_cast<double>(service_every_ * step_ns_) * 1e-9);
}

Status Emulator::status() const {
  Status status;
  status.silenced = silenced_;
  status.time = time();
  status.steps = step_;
  status.speed = pace_.speed;
  status.paused = pace_.paused;
  status.steps_left = pace_.steps_left;
  status.gate = router_.gate().state();
  Copy(router_.owner().active(), &status.motion_service);
  status.motion = router_.owner().state();
  status.arm_weight = router_.service_on() ? router_.arm_weight(time()) : 0;
  status.remote = state_.remote;
  status.stick_wish = router_.stick_wish();
  status.commands = router_.gate().counts();
  status.last_refusal = last_refusal_;
  status.arm_commands = router_.arm_counts();
  status.user_commands = router_.user_counts();
  status.port = port_->counts();
  status.published = published_;
  status.divergences = divergences_;
  status.orders = orders_;
  status.script_done = script_next_;
  status.script_refused = script_refused_;
  Copy(script_refusal_, &status.script_refusal);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    HandStatus& hand = status.hands[i];
    Copy(config_.robot.hands[i].name, &hand.name);
    hand.commands = hands_[i].counts();
    hand.last_refusal = hands_[i].last_refusal();
  }
  status.crane_attached = crane_.attached();
  status.crane_length = crane_.length();
  status.crane_tension = crane_.tension();
  status.clamped = world_.clamped();
  status.base_height = world_.base().p_WB.z();
  status.tilt = world_.tilt();
  return status;
}

std::vector<Emulator::Start> Emulator::StartsOf(const config::Config& config) {
  const robot::RobotSpec& robot = config.robot;
  const robot::RobotCommand damping =
      authority::DampingCommand(robot.motors.size(), config.gate.damping_kd);
  return {{.command = damping, .pose = robot.lying},
          {.command = HoldCommand(robot, robot.standing.q), .pose = robot.standing},
          {.command = damping, .pose = robot.hanging, .on_crane = true},
          {.command = damping, .pose = robot.hanging, .clamped = true}};
}

std::int64_t Emulator::Every(double hz) const {
  return std::llround(1e9 / (hz * static_cast<double>(step_ns_)));
}

void Emulator::To(const Start& start) {
  router_.Restart(start.command);
  delay_.Restart(start.command);
  for (Hand& hand : hands_) hand.Restart();
  pushes_.Clear();
  drags_.Clear();
  world_.Reset(start.pose);
  crane_.Release();
  if (start.on_crane) HangFromCrane();
  world_.Clamp(start.clamped);
  sampled_ = kNever;
}

wire::Due Emulator::DueNow() const {
  return {.lowstate = step_ % lowstate_every_ == 0,
          .motion = step_ % motion_every_ == 0,
          .hands = !hands_.empty() && step_ % hand_every_ == 0,
          .lf = step_ % lf_every_ == 0};
}

void Emulator::MoveHands(double t) {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    world_.DriveHand(i, hands_[i].Step(world_.hand_q(i), world_.hand_dq(i), t));
  }
}

void Emulator::Sample(std::int64_t step) {
  sampled_ = step;
  sensors_.Sample(world_, motors_, *command_, battery_, step * step_ns_ / 1'000'000, &state_);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    hands_[i].Sample(world_.hand_q(i), world_.hand_dq(i), &state_.hands[i]);
  }
  state_.remote = remote_.Read(static_cast<double>(step * step_ns_) * 1e-9);
  state_.motion = router_.motion();
}

void Emulator::PushAndPull(double t) {
  pushes_.Act(t, &world_);
  drags_.Act(t, &world_);
  if (!crane_.attached()) return;
  const physics::PointReading hook = world_.Point(crane_body_, crane_point_);
  world_.AddForce(crane_body_, hook.p_WP, crane_.Step(hook, world_.timestep()));
}

void Emulator::HangFromCrane() {
  crane_.Attach(world_.Point(crane_body_, crane_point_).p_WP, world_.weight());
}

}  // namespace understudy::emulator
