#include "tests/motion/humanoid/fixture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <mujoco/mujoco.h>

#include "config/load.h"
#include "physics/world_model.h"

namespace understudy::motion {
namespace {

const std::filesystem::path kData(UNDERSTUDY_SOURCE_DIR);

physics::World MakeWorld(const robot::RobotSpec& spec, const std::function<void(mjModel&)>& change,
                         double timestep) {
  mjcf::ModelHandle model = physics::LoadWorldModel({{spec, kData / "models" / spec.model}},
                                                    kData / "models/scene/flat.xml", timestep);
  if (change) change(*model);
  return {std::move(model), {{spec}}};
}

}  // namespace

config::Config HumanoidConfig(const std::string& robot) {
  const std::size_t space = robot.find(' ');
  if (space == std::string::npos) return config::LoadConfig({.robot = robot}, kData);
  return config::LoadConfig({.robot = robot.substr(0, space),
                             .files = {},
                             .sets = {"robot.revision=" + robot.substr(space + 1)}},
                            kData);
}

HumanoidRig::HumanoidRig(const std::string& robot, const std::function<void(mjModel&)>& change,
                         double timestep)
    : config_(HumanoidConfig(robot)),
      world_(MakeWorld(config_.robot, change, timestep)),
      motors_(config_.robot),
      battery_(config_.robot.battery),
      sensors_(sensors::SensorConfig{}, config_.robot),
      motion_(MakeHumanoidMotion(config_.robot, world_.robot())),
      hook_body_(world_.robot().Body(config_.robot.crane_body)),
      hook_(config_.robot.crane_point),
      command_{.motors = std::vector<robot::MotorCommand>(robot::AllMotors(spec()).size())},
      torque_(spec().motors.size()) {}

void HumanoidRig::Stand() {
  world_.robot().Reset(spec().standing);
  crane_.Release();
  Sense();
  motion_->Start(input_);
}

void HumanoidRig::Hang() {
  world_.robot().Reset(spec().hanging);
  crane_.Attach(world_.Point(hook_body_, hook_).p_WP, world_.robot().weight());
  Sense();
  motion_->Start(input_);
}

void HumanoidRig::Sense() {
  // As in the tick, all of the step before. Forces are not to be had between BeginStep and EndStep.
  sensors_.Sample(world_.robot(), motors_, command_, battery_, 0, &state_);
  input_ = {
      .time = time_, .motors = state_.motors, .imu = state_.imu, .foot_force = state_.foot_force};
}

bool HumanoidRig::Run(double seconds) {
  const auto steps = static_cast<int>(std::lround(seconds / world_.timestep()));
  for (int i = 0; i < steps; ++i) {
    Sense();
    motion_->Step(input_, world_.timestep(), &command_);
    if (change_command) change_command(command_);
    world_.BeginStep();
    motors_.Step(command_, world_.robot().q(), world_.robot().dq(), world_.timestep());
    for (std::size_t m = 0; m < torque_.size(); ++m) {
      torque_change = std::max(torque_change, std::abs(motors_.torque()[m] - torque_[m]));
      torque_[m] = motors_.torque()[m];
    }
    const physics::PointReading hook = world_.Point(hook_body_, hook_);
    world_.AddForce(hook_body_, hook.p_WP, crane_.Step(hook, world_.timestep()));
    if (push_left_ > 0) {
      world_.AddForce(hook_body_, hook.p_WP, push_);
      push_left_ -= world_.timestep();
    }
    world_.robot().Drive(motors_.torque());
    if (world_.EndStep() != physics::StepHealth::kFine) return false;
    time_ += world_.timestep();
    if (watch) watch();
  }
  return true;
}

void HumanoidRig::SetDown(int id) {
  Hang();
  SetFsm(kDampingId);
  SetFsm(spec().motion.humanoid.lock_stand);
  Run(5);
  crane_.Lower(0.4);
  Run(4.5);
  if (id != spec().motion.humanoid.lock_stand) {
    SetFsm(id);
    Run(1);
  }
  crane_.Release();
}

void HumanoidRig::Push(const Eigen::Vector3d& impulse, double duration) {
  push_ = impulse / duration;
  push_left_ = duration;
}

double HumanoidRig::Load() const {
  return std::accumulate(state_.foot_force.begin(), state_.foot_force.end(), 0.0);
}

double HumanoidRig::DeepestSelfContact() const {
  double deepest = 0;
  for (int i = 0; i < world_.data().ncon; ++i) {
    const mjContact& contact = world_.data().contact[i];
    if (world_.model().geom_bodyid[contact.geom1] == 0) continue;
    if (world_.model().geom_bodyid[contact.geom2] == 0) continue;
    deepest = std::max(deepest, -contact.dist);
  }
  return deepest;
}

double HumanoidRig::FastestJoint() const {
  double fastest = 0;
  for (const double dq : world_.robot().dq()) fastest = std::max(fastest, std::abs(dq));
  return fastest;
}

double HumanoidRig::q(const std::string& joint) const {
  const auto found = std::find_if(spec().motors.begin(), spec().motors.end(),
                                  [&](const robot::MotorSpec& m) { return m.joint == joint; });
  return world_.robot().q()[static_cast<std::size_t>(found - spec().motors.begin())];
}

}  // namespace understudy::motion
