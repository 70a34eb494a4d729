#include "emulator/robot.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "authority/onboard.h"
#include "base/errors.h"
#include "base/nearest_word.h"
#include "emulator/request.h"
#include "motion/controllers.h"
#include "robot/command_topics.h"
#include "robot/hand_law.h"

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
std::vector<std::string> Links(const robot::RobotSpec& spec, const wire::RobotPort& port) {
  std::vector<std::string> links = robot::CommandTopicNames(spec);
  std::ranges::copy(port.topics(), std::back_inserter(links));
  return links;
}

}  // namespace

Robot::Robot(const RobotParts& parts, std::uint8_t index, physics::MujocoWorld* physics,
             perception::RayCaster* rays, EventRing* events)
    : spec_(parts.spec),
      settings_(parts.settings),
      starts_(StartsOf(spec_, settings_.gate.damping_kd)),
      physics_(physics),
      body_(&physics->robot(index)),
      ranges_(body_->ranges()),
      faults_(spec_, Links(spec_, *parts.ports.topics),
              parts.ports.services == nullptr ? std::vector<std::string>()
                                              : parts.ports.services->names(),
              settings_.sensors.seed,
              parts.ports.services == nullptr ? std::vector<std::string>()
                                              : parts.ports.services->topics()),
      events_(spec_, index, events),
      computer_(
          spec_, settings_, parts.ports, faults_, start(settings_.start).command,
          [this](std::string_view alias) {
            return motion::MakeMotion({.spec = spec_,
                                       .service = authority::MotionService(spec_, alias),
                                       .body = *body_,
                                       .damping_kd = settings_.gate.damping_kd});
          },
          physics->timestep(), &events_),
      hardware_(spec_, settings_.sensors, faults_, computer_.command(), body_, physics->timestep()),
      rays_(rays),
      crane_(settings_.crane),
      crane_body_(body_->Body(spec_.crane_body)),
      hand_names_(robot::HandNames(spec_)) {
  for (const robot::PlannedFault& fault : settings_.faults) {
    const auto planned = faults_.Plan(fault);
    if (!planned) throw ConfigError("faults: " + planned.why());
  }
  if (robot::HasLidar(spec_.lidar)) {
    eyes_.emplace(spec_, settings_.sensors, *physics, *body_, *rays);
  }
  Reset(settings_.start);
  if (settings_.boot) {
    SwitchOff();
    SwitchOn(0);
  }
  computer_.NoteStart();
  NoteChanges(0);
}

std::vector<Robot::Start> Robot::StartsOf(const robot::RobotSpec& spec, double damping_kd) {
  const robot::RobotCommand damping = authority::DampingCommand(spec.motors.size(), damping_kd);
  return {{.command = damping, .pose = spec.lying},
          {.command = HoldCommand(spec, spec.standing.q), .pose = spec.standing},
          {.command = damping, .pose = spec.hanging, .on_crane = true},
          {.command = damping, .pose = spec.hanging, .clamped = true}};
}

void Robot::Hear(std::int64_t step, double t) {
  StepFaults(t);
  computer_.TakeCommands(t);
  if (computer_.NeedsSample(step)) Sample(step - 1);
  const robot::RobotCommand& command = computer_.Command(step, t);
  if (!WhyNoJoints().empty()) hardware_.ReleaseJoints();
  hardware_.Send(command, t);
  NoteChanges(t);
}

void Robot::Act() {
  hardware_.Act();
  if (hardware_.battery().cut_off() != robot::CutOff::kNone) SwitchOff();
  if (hardware_.motors().heated()) events_.CompareHeat(hardware_.motors());
  events_.CompareBattery(hardware_.battery());
  if (!crane_.attached()) return;
  const physics::Crane::Hooks at = hooks();
  const physics::Crane::Pulls pulls = crane_.Step(at, physics_->timestep());
  for (std::size_t i = 0; i < at.size(); ++i) {
    physics_->AddForce(crane_body_, at[i].p_WP, pulls[i]);
  }
}

void Robot::Tell(std::int64_t step) {
  hardware_.Sense();
  if (computer_.Due(step)) Sample(step);
  computer_.Publish(step);
  if (eyes_) eyes_->Look(step, physics_->data(), faults_.effects().lidar, rays_, &computer_);
}

void Robot::Reset(robot::StartPose pose) {
  const Start& begin = start(pose);
  if (computer_.power() != robot::PowerState::kOn && !board_is_dead_ && hardware_.SwitchOn()) {
    computer_.SkipBoot();
  }
  computer_.Restart(begin.command);
  hardware_.Restart(computer_.command(), begin.pose);
  crane_.Release();
  if (begin.on_crane) AttachCrane();
  body_->Clamp(begin.clamped);
}

physics::Crane::Hooks Robot::hooks() const {
  const Eigen::Vector3d left(0, physics::Crane::kHookOffset, 0);
  return {physics_->Point(crane_body_, spec_.crane_point + left),
          physics_->Point(crane_body_, spec_.crane_point - left)};
}

// Returns "" if joints can be moved now, else the reason.
std::string_view Robot::WhyNoJoints() const {
  if (!body_->clamped()) return "the robot is not clamped; `clamp on` holds it";
  if (computer_.power() == robot::PowerState::kOff) return "the robot is switched off";
  return computer_.is_commanded() ? "a program commands the motors" : "";
}

Result<> Robot::MoveJoint(std::string_view joint, double angle, double until) {
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
  hardware_.MoveJoint(i, angle, until);
  return {};
}

void Robot::FollowSettings() {
  hardware_.Apply(settings_.sensors);
  if (eyes_) eyes_->Apply(settings_.sensors);
  computer_.Apply(settings_);
  crane_.Apply(settings_.crane);
}

void Robot::NoteChanges(double t) {
  computer_.NoteChanges(t);
  events_.CompareHolds(crane_.attached(), body_->clamped());
}

void Robot::Report(double t, Status* status) const {
  computer_.Report(t, status);
  status->crane_attached = crane_.attached();
  status->crane_length = crane_.length();
  status->crane_tension = crane_.tension();
  status->clamped = body_->clamped();
  status->base_height = body_->base().p_WB.z();
  status->tilt = body_->tilt();
  std::array<double, robot::kMostHandNames> forces{};
  body_->HandForces(std::span(forces).first(hand_names_.size()));
  for (std::size_t i = 0; i < hand_names_.size(); ++i) {
    CopyText(hand_names_[i], &status->hand_forces[i].name);
    status->hand_forces[i].force = forces[i];
  }
}

}  // namespace understudy::emulator
