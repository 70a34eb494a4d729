#include "tests/motion/quadruped/rig.h"

#include <algorithm>
#include <cmath>

#include "config/load.h"
#include "physics/world_model.h"

namespace understudy::motion {
namespace {

const std::filesystem::path kRoot = UNDERSTUDY_SOURCE_DIR;

physics::World MakeWorld(const config::Config& config, const std::filesystem::path& scene) {
  return {physics::LoadWorldModel({{config.robot, kRoot / "models" / config.robot.model}}, scene,
                                  config.physics.timestep),
          {{config.robot}}};
}

}  // namespace

std::filesystem::path QuadrupedRig::FlatScene() { return kRoot / "models" / "scene" / "flat.xml"; }

QuadrupedRig::QuadrupedRig(const std::string& robot, const std::vector<std::string>& settings,
                           const std::filesystem::path& scene)
    : config_(config::LoadConfig({.robot = robot, .sets = settings}, kRoot)),
      world_(MakeWorld(config_, scene)),
      motors_(config_.robot),
      battery_(config_.robot.battery),
      sensors_(config_.sensors, config_.robot),
      motion_(MakeQuadrupedMotion(spec(), world_.robot())),
      saturated_(spec().motors.size()) {
  command_.motors.resize(spec().motors.size());
  StartLying();
}

void QuadrupedRig::Start(const robot::PoseSpec& pose) {
  world_.robot().Reset(pose);
  std::fill(command_.motors.begin(), command_.motors.end(), robot::MotorCommand{});
  std::fill(saturated_.begin(), saturated_.end(), 0.0);
  longest_ = 0;
  sensors_.Sample(world_.robot(), motors_, command_, battery_, 0, &sensed_);
  motion_->Start(Input());
}

void QuadrupedRig::StandUp() {
  StartLying();
  Run(0.2);
  Ask(goal::StandUp{});
  Run(3);
}

void QuadrupedRig::BalanceStand() {
  StandUp();
  Ask(goal::BalanceStand{});
  Run(2);
}

void QuadrupedRig::Run(double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / world_.timestep()));
  for (int i = 0; i < steps; ++i) Tick();
}

bool QuadrupedRig::RunUntil(int id, double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / world_.timestep()));
  for (int i = 0; i < steps && state().id != id; ++i) Tick();
  return state().id == id;
}

void QuadrupedRig::Push(const Eigen::Vector3d& force, double seconds) {
  push_ = force;
  Run(seconds);
  push_.setZero();
}

Eigen::Vector3d QuadrupedRig::rpy() const {
  const Eigen::Matrix3d R = world_.robot().Imu().R_WI.toRotationMatrix();
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)),
          std::atan2(R(1, 0), R(0, 0))};
}

double QuadrupedRig::fastest() const {
  double speed = 0;
  for (const double dq : world_.robot().dq()) speed = std::max(speed, std::abs(dq));
  return speed;
}

authority::MotionInput QuadrupedRig::Input() {
  foot_force_ = sensed_.foot_force;
  std::uniform_real_distribution<double> noise(1 - foot_noise, 1 + foot_noise);
  for (double& force : foot_force_) force *= noise(random_);
  return {.time = time_, .motors = sensed_.motors, .imu = sensed_.imu, .foot_force = foot_force_};
}

// The service sees the sample of the step before, as one on the robot's own computer does.
void QuadrupedRig::Tick() {
  const double dt = world_.timestep();
  motion_->Step(Input(), dt, &command_);
  if (watch) watch();
  world_.BeginStep();
  const std::span<const double> tau =
      motors_.Step(command_, world_.robot().q(), world_.robot().dq(), dt);
  if (!push_.isZero()) {
    world_.AddForce(world_.robot().Body(spec().base_body), world_.robot().base().p_WB, push_);
  }
  world_.robot().Drive(tau);
  (void)world_.EndStep();
  sensors_.Sample(world_.robot(), motors_, command_, battery_, 0, &sensed_);
  time_ += dt;
  for (std::size_t i = 0; i < saturated_.size(); ++i) {
    const bool full = std::abs(tau[i]) >= 0.999 * spec().motors[i].torque_limit;
    saturated_[i] = full ? saturated_[i] + dt : 0;
    longest_ = std::max(longest_, saturated_[i]);
  }
}

}  // namespace understudy::motion
