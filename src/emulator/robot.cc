#include "emulator/robot.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "authority/onboard.h"
#include "base/errors.h"
#include "base/nearest_word.h"
#include "motion/make_motion.h"

namespace understudy::emulator {
namespace {

// The command that holds `q` against gravity with the gains of the robot's description.
robot::RobotCommand HoldCommand(const robot::RobotSpec& spec, const std::vector<double>& q) {
  robot::RobotCommand command;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const robot::MotorSpec& motor = spec.motors[i];
    command.motors.push_back(
        {.enabled = true, .q = q[i], .kp = motor.hold_kp, .kd = motor.hold_kd});
  }
  return command;
}

// All topics that can have faults: those of commands, then those of states.
std::vector<std::string> Links(const std::vector<std::string>& commands,
                               const wire::RobotPort& port) {
  std::vector<std::string> links = commands;
  std::ranges::copy(port.topics(), std::back_inserter(links));
  return links;
}

}  // namespace

std::vector<std::string> CommandTopics(const robot::RobotSpec& spec) {
  std::vector<std::string> topics(robot::kCommandTopicNames.begin(),
                                  robot::kCommandTopicNames.end());
  if (spec.arm_sdk.slots.empty()) topics[robot::kArmSdkTopic].clear();
  if (!spec.user_lowcmd) topics[robot::kUserLowCmdTopic].clear();
  for (const robot::HandSpec& hand : spec.hands) topics.push_back("rt/" + hand.topic + "/cmd");
  return topics;
}

Robot::Robot(const RobotParts& parts, std::uint8_t index, physics::World* physics,
             EventRing* events)
    : spec_(parts.spec),
      settings_(parts.settings),
      topics_(CommandTopics(spec_)),
      first_service_(authority::StartService(spec_, {})),
      start_pose_(parts.settings.start),
      starts_(StartsOf(spec_, parts.settings.gate.damping_kd)),
      physics_(physics),
      body_(&physics->robot(index)),
      events_(spec_, index, topics_, events),
      port_(parts.port),
      services_(parts.services),
      router_(spec_, parts.settings.gate, parts.settings.motion, start(start_pose_).command,
              motion::MakeMotion(spec_, *body_, parts.settings.gate.damping_kd)),
      ranges_(body_->ranges()),
      rig_(HoldCommand(spec_, std::vector<double>(spec_.motors.size())).motors,
           router_.command().motors.size()),
      transport_(spec_, physics_->timestep(), parts.settings.sensors.seed, router_.command()),
      faults_(spec_, Links(topics_, *port_),
              services_ == nullptr ? std::vector<std::string>() : services_->names(),
              parts.settings.sensors.seed),
      encoders_(sensors::EncoderZeros(parts.settings.sensors, spec_), parts.settings.sensors.seed),
      motors_(spec_, physics_->timestep()),
      gears_(spec_, body_->Armatures(), physics_->timestep()),
      battery_(spec_.battery, spec_.thermal.ambient_c, parts.settings.sensors.seed),
      board_(spec_),
      power_(spec_.boot),
      service_effects_(faults_.effects().services),
      damage_(spec_, body_->ranges()),
      sensors_(parts.settings.sensors, spec_, physics_->timestep()),
      crane_(parts.settings.crane),
      crane_body_(body_->Body(spec_.crane_body)),
      crane_point_(spec_.crane_point),
      step_ns_(std::llround(physics_->timestep() * 1e9)),
      service_rate_(spec_.rates.service_hz, physics_->timestep()),
      command_(&router_.command()),
      offered_(*command_),
      braked_(faults_.effects().motors),
      friction_w_(braked_.size()) {
  for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
    links_.emplace_back(topic < robot::kFirstHandTopic, *command_);
  }
  for (const robot::PlannedFault& fault : parts.settings.faults) {
    const auto planned = faults_.Plan(fault);
    if (!planned) throw ConfigError("faults: " + planned.why());
  }
  Reset(start_pose_);
  if (parts.settings.boot) {
    SwitchPowerOff();
    power_.SwitchOn(0);
  }
  events_.Begin(present(0));
}

void Robot::ServeCalls(double t, time::Clock::Time now) {
  if (services_ == nullptr) return;
  const std::span<const services::Call> calls = services_->Poll(&router_.owner(), now);
  for (const services::Call& call : calls) events_.AddCall(call, router_.owner().state().id);
  if (!calls.empty()) NoteChanges(t);
}

std::optional<std::int32_t> Robot::Call(std::string_view service, std::int64_t api_id,
                                        std::string_view parameter, time::Clock::Time now) {
  if (services_ == nullptr) return std::nullopt;
  const auto call = services_->Answer(service, api_id, parameter, &router_.owner(), now);
  if (call) events_.AddCall(*call, router_.owner().state().id);
  return call ? std::optional(call->code) : std::nullopt;
}

void Robot::Hear(std::int64_t step, double t) {
  StepFaults(t);
  StepPower(t);
  TakeCommands(t);
  const robot::RobotCommand& decided = Decide(step, t);
  if (rig_.moves() && !WhyNoJoints().empty()) rig_.Release();
  const robot::RobotCommand& wanted = rig_.Over(decided, t, physics_->timestep());
  const std::span<const robot::BusEffects> buses = faults_.effects().buses;
  command_ =
      &transport_.Pass(wanted, t, faults_.any() ? buses : std::span<const robot::BusEffects>());
  NoteChanges(t);
}

// Returns "" if joints can be moved now, else the reason.
std::string_view Robot::WhyNoJoints() const {
  if (!body_->clamped()) return "the robot is not clamped; `clamp on` holds it";
  if (power_.state() == PowerState::kOff) return "the robot is switched off";
  if (router_.gate().state() == authority::GateState::kFollowing ||
      router_.owner().user_control()) {
    return "a program commands the motors";
  }
  return {};
}

Result<> Robot::MoveJoint(std::string_view joint, double angle, double until, double t) {
  if (const std::string_view why = WhyNoJoints(); !why.empty()) return Error{std::string(why)};
  const auto motor = std::ranges::find(spec_.motors, joint, &robot::MotorSpec::joint);
  if (motor == spec_.motors.end()) {
    std::vector<std::string> joints;
    for (const robot::MotorSpec& one : spec_.motors) joints.push_back(one.joint);
    return Error{"no motor of the body has a joint '" + std::string(joint) + "'" +
                 NearestHint(joint, joints)};
  }
  const auto i = static_cast<std::size_t>(motor - spec_.motors.begin());
  const auto& [low, high] = ranges_[i];
  if (!(angle >= low && angle <= high)) {
    return Error{motor->joint + ": expected an angle from " + NumberText(low) + " to " +
                 NumberText(high) + " rad, got " + NumberText(angle)};
  }
  rig_.Move(i, angle, body_->q()[i], std::max(until, t));
  return {};
}

void Robot::FollowSettings() {
  sensors_.Follow(settings_.sensors);
  router_.Follow(settings_.gate, settings_.motion);
  crane_.Follow(settings_.crane);
}

void Robot::Rest() { port_->Rest(); }

void Robot::Act() {
  const double dt = physics_->timestep();
  const robot::Effects& faults = faults_.effects();
  const bool off = power_.state() == PowerState::kOff;
  ReadEncoders();
  body_->FrictionPower(friction_w_);
  motors_.Step({.command = *command_,
                .q = encoders_.q(),
                .dq = encoders_.dq(),
                .rate = body_->dq(),
                .friction_w = friction_w_,
                .supply = off ? robot::MotorSupply{.voltage = 0, .most_power = 0, .on = false}
                              : battery_.supply(),
                .faults = faults.motors});
  body_->Drive(gears_.ideal() ? motors_.torque() : gears_.Step(motors_.torque(), body_->q()));
  if (!off) battery_.Step(motors_.power(), dt, faults.battery);
  if (battery_.cut_off() != robot::CutOff::kNone) SwitchPowerOff();
  if (!board_.settled() || faults_.any()) board_.Step(dt, faults.fans, faults.board);
  if (motors_.heated()) events_.CompareHeat(motors_);
  events_.CompareBattery(battery_);
  if (crane_.attached()) {
    const physics::Crane::Hooks at = hooks();
    const physics::Crane::Pulls pulls = crane_.Step(at, dt);
    for (std::size_t i = 0; i < at.size(); ++i) {
      physics_->AddForce(crane_body_, at[i].p_WP, pulls[i]);
    }
  }
}

void Robot::ReadEncoders() {
  if (!gears_.ideal()) gears_.AddPlay(body_->q(), body_->dq());
  encoders_.Step(gears_.ideal() ? body_->q() : gears_.q(),
                 gears_.ideal() ? body_->dq() : gears_.dq(), faults_.effects().encoders);
}

void Robot::Tell(std::int64_t step) {
  damage_.Step({.command = *command_,
                .q = body_->q(),
                .dq = body_->dq(),
                .torque = motors_.torque(),
                .winding_c = motors_.winding_c(),
                .battery = battery_.reading(),
                .f_WI_I = body_->Imu().f_WI_I,
                .tilt = body_->tilt()},
               physics_->timestep());
  if (!power_.computes()) return;
  if (services_ != nullptr && !silenced_) {
    services_->Tell(router_.owner(), static_cast<double>(step * step_ns_) * 1e-9);
  }
  sensors_.Step(instant());
  if (!port_->Due(step)) return;
  Sample(step);
  const std::span<const robot::LinkEffects> links = faults_.effects().links;
  if (!silenced_) port_->Publish(state_, step, links.subspan(topics_.size()));
  events_.AddNews(port_->TakeNews());
}

// The motion service gets the sample of the step before, as on a real robot: where their rates are
// equal the published one, since it is due in the steps after those of that rate (and in the first,
// so that it leads the robot from the start). Nothing is sampled for it while no service is on.
const robot::RobotCommand& Robot::Decide(std::int64_t step, double t) {
  const bool service_due = step == 0 || service_rate_.Due(step - 1);
  input_.time = t;
  if (service_due && router_.service_on()) {
    if (sampled_ != step - 1) Sample(step - 1);
    input_.motors = state_.motors;
    input_.imu = state_.imu;
    input_.foot_force = state_.foot_force;
    input_.soc = state_.battery.soc;
    input_.arm_weight = router_.arm_weight(t);
    input_.remote = state_.remote;
  }
  return router_.Current(input_, service_due,
                         static_cast<double>(service_rate_.every() * step_ns_) * 1e-9);
}

robot::RemoteReading Robot::ReadRemote(double t) {
  const bool deaf = faults_.effects().remote_off || !power_.computes();
  return deaf ? robot::RemoteReading{} : remote_.Read(t);
}

void Robot::Silence(bool on) {
  if (on != silenced_) events_.Add(EventKind::kSilence, {on ? 1.0 : 0.0});
  silenced_ = on;
}

void Robot::NoteChanges(double t) { events_.Compare(present(t)); }

void Robot::Report(double t, Status* status) const {
  status->power = power_.state();
  status->silenced = silenced_;
  status->gate = router_.gate().state();
  CopyText(router_.owner().active(), &status->motion_service);
  status->motion = router_.owner().state();
  status->arm_weight = router_.service_on() ? router_.arm_weight(t) : 0;
  status->remote = state_.remote;
  status->stick_wish = router_.stick_wish();
  status->commands = router_.counts(robot::kLowCmdTopic);
  status->arm_commands = router_.counts(robot::kArmSdkTopic);
  status->user_commands = router_.counts(robot::kUserLowCmdTopic);
  status->port = port_->counts();
  status->command_writers = port_->command_writers();
  if (services_ != nullptr) status->services = services_->counts();
  status->published = status->port.lowstates;
  for (std::size_t i = 0; i < spec_.hands.size(); ++i) {
    HandStatus& hand = status->hands[i];
    CopyText(spec_.hands[i].name, &hand.name);
    hand.commands = router_.counts(robot::kFirstHandTopic + i);
  }
  status->crane_attached = crane_.attached();
  status->crane_length = crane_.length();
  status->crane_tension = crane_.tension();
  status->clamped = body_->clamped();
  status->base_height = body_->base().p_WB.z();
  status->tilt = body_->tilt();
}

std::vector<Robot::Start> Robot::StartsOf(const robot::RobotSpec& spec, double damping_kd) {
  const robot::RobotCommand damping = authority::DampingCommand(spec.motors.size(), damping_kd);
  return {{.command = damping, .pose = spec.lying},
          {.command = HoldCommand(spec, spec.standing.q), .pose = spec.standing},
          {.command = damping, .pose = spec.hanging, .on_crane = true},
          {.command = damping, .pose = spec.hanging, .clamped = true}};
}

void Robot::Reset(robot::StartPose pose) {
  const Start& begin = start(pose);
  battery_.Restart();
  if (power_.state() != PowerState::kOn && battery_.cut_off() == robot::CutOff::kNone &&
      !board_is_dead_) {
    power_.Skip();
    Suffer();
    router_.owner().Select(before_off_);
  }
  rig_.Release();
  router_.Restart(begin.command);
  transport_.Restart(router_.command());
  body_->Reset(begin.pose);
  crane_.Release();
  if (begin.on_crane) AttachCrane();
  body_->Clamp(begin.clamped);
  gears_.Restart();
  ReadEncoders();
  sensors_.Restart(instant());
  damage_.Restart();
  sampled_ = kNever;
}

void Robot::AttachCrane() { crane_.Attach(hooks(), body_->weight()); }

physics::Crane::Hooks Robot::hooks() const {
  const Eigen::Vector3d left(0, physics::Crane::kHookOffset, 0);
  return {physics_->Point(crane_body_, crane_point_ + left),
          physics_->Point(crane_body_, crane_point_ - left)};
}

void Robot::Sample(std::int64_t step) {
  sampled_ = step;
  const std::int64_t since_ns = std::llround(power_.since() * 1e9);
  sensors_.Sample(instant(), (step * step_ns_ - since_ns) / 1'000'000, &state_);
  state_.remote = ReadRemote(static_cast<double>(step * step_ns_) * 1e-9);
  state_.motion = router_.motion();
}

}  // namespace understudy::emulator
