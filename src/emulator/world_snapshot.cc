// Fills in a Snapshot.
#include <algorithm>

#include "emulator/world.h"
#include "robot/pads.h"

namespace understudy::emulator {
namespace {

bool Has(const Snapshot& snapshot, SnapshotPart part) { return (snapshot.parts & part) != 0; }

std::array<double, 3> Array(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

}  // namespace

Snapshot World::MakeSnapshot(std::size_t robot) const {
  const robot::RobotSpec& spec = robots_[robot].spec();
  Snapshot snapshot;
  snapshot.robot = robot;
  snapshot.positions.resize(physics::PositionCount(physics_));
  snapshot.body_names = physics::BodyNames(physics_);
  for (const robot::MotorSpec* motor : robot::AllMotors(spec)) {
    snapshot.motor_names.push_back(motor->joint);
  }
  snapshot.command_topics = robots_[robot].topics();
  snapshot.bodies.resize(snapshot.body_names.size());
  snapshot.contacts.reserve(kMostSnapshotContacts);
  snapshot.pushes.reserve(robots_.size() * (physics::Pushes::kMost + physics::Drags::kMost));
  snapshot.motors.resize(snapshot.motor_names.size());
  snapshot.imu_count = spec.imu.secondary_site.empty() ? 1 : 2;
  snapshot.feet.resize(spec.feet.size());
  snapshot.command.resize(snapshot.motor_names.size());
  const robot::FaultBank& faults = robots_[robot].faults();
  snapshot.components = faults.components();
  for (std::size_t i = 0; i < snapshot.components.size(); ++i) {
    snapshot.component_faults.push_back(faults.KindsOf(i));
  }
  snapshot.limits = robot::MotorLimitsOf(spec);
  snapshot.damage_limits = robot::DamageLimitsOf(spec);
  snapshot.trip_c = spec.thermal.trip_c;
  snapshot.setting_keys.assign(settings_.keys.begin(), settings_.keys.end());
  snapshot.settings.resize(settings_.keys.size());
  snapshot.faults.reserve(robot::FaultBank::kMost);
  snapshot.damage.motors.resize(snapshot.motor_names.size());
  snapshot.truth.q.resize(snapshot.motor_names.size());
  snapshot.truth.dq.resize(snapshot.motor_names.size());
  snapshot.truth.tau.resize(snapshot.motor_names.size());
  snapshot.truth.foot_force.resize(spec.feet.size());
  snapshot.touch.resize(robot::CellsOf(spec));
  return snapshot;
}

void World::Show(Snapshot* snapshot) const {
  const Robot& robot = robots_[snapshot->robot];
  const robot::RobotState& state = robot.sampled();
  snapshot->step = step_;
  snapshot->time = time();
  snapshot->speed = pace_.speed;
  snapshot->paused = pace_.paused;
  if (Has(*snapshot, kPartPositions)) physics::ReadPositions(physics_, snapshot->positions);
  if (Has(*snapshot, kPartBodies)) physics::ReadBodies(physics_, snapshot->bodies);
  if (Has(*snapshot, kPartContacts)) {
    snapshot->contacts.resize(kMostSnapshotContacts);
    snapshot->contacts.resize(physics::ReadContacts(physics_, snapshot->contacts));
  }
  if (Has(*snapshot, kPartCom)) {
    const std::string& base = physics_.robot(snapshot->robot).spec().base_body;
    snapshot->com = physics::SubtreeCenterOfMass(physics_, physics_.FindBody(base));
  }
  if (Has(*snapshot, kPartCrane)) {
    snapshot->crane = {.attached = robot.crane().attached(),
                       .hook = Array(robot.hook().p_WP),
                       .top = Array(robot.crane().anchor()),
                       .tension = robot.crane().tension()};
  }
  if (Has(*snapshot, kPartPushes)) {
    snapshot->pushes.clear();
    const auto add = [snapshot](std::span<const physics::AppliedForce> forces) {
      for (const physics::AppliedForce& force : forces) {
        snapshot->pushes.push_back(
            {.body = force.body, .at = Array(force.p_WP), .force = Array(force.force_W)});
      }
    };
    for (const Forces& forces : forces_) {
      add(forces.pushes.forces());
      add(forces.drags.forces());
    }
  }
  // Nothing has been sampled before the first tick.
  if (Has(*snapshot, kPartMotors)) std::ranges::copy(state.motors, snapshot->motors.begin());
  snapshot->imus = {state.imu, state.secondary_imu};
  snapshot->battery = state.battery;
  std::copy_n(state.foot_force.begin(), std::min(state.foot_force.size(), snapshot->feet.size()),
              snapshot->feet.begin());
  snapshot->remote = state.remote;
  if (Has(*snapshot, kPartCommand)) snapshot->command = robot.command().motors;
  if (Has(*snapshot, kPartFaults)) {
    snapshot->faults.clear();
    for (const robot::Fault& fault : robot.faults().faults()) {
      snapshot->faults.push_back({fault.component, fault.kind, fault.by, fault.from});
    }
  }
  if (Has(*snapshot, kPartDamage)) snapshot->damage = robot.damage();
  // As the motors: nothing before the first tick.
  if (Has(*snapshot, kPartTruth) && !state.truth.q.empty()) snapshot->truth = state.truth;
  if (Has(*snapshot, kPartTouch)) physics_.robot(snapshot->robot).ReadTouch(snapshot->touch);
  if (Has(*snapshot, kPartSettings)) {
    for (std::size_t i = 0; i < snapshot->settings.size(); ++i) {
      snapshot->settings[i] = Setting(i, robot);
    }
    snapshot->ground_friction = physics_.GroundFriction();
  }
  if (Has(*snapshot, kPartMotion)) {
    const robot::MotionState& motion = robot.owner().state();
    CopyText(robot.owner().active(), &snapshot->motion.service);
    snapshot->motion.state = motion.id;
    snapshot->motion.name = motion.name;
  }
}

}  // namespace understudy::emulator
