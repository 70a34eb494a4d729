#include "tests/motion/rig.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "assembly/make_world.h"
#include "config/load.h"
#include "emulator/told_event.h"
#include "tests/support/requests.h"

namespace understudy::motion {
namespace {

const std::filesystem::path kRoot = UNDERSTUDY_SOURCE_DIR;

}  // namespace

config::Config ConfigOf(const std::string& robot, const std::vector<std::string>& settings) {
  return config::LoadConfig({.robot = robot, .files = {}, .sets = settings}, kRoot);
}

std::filesystem::path FlatScene() { return kRoot / "models" / "scene" / "flat.xml"; }

double RestSeconds(double usual) {
  const char* const given = std::getenv("UNDERSTUDY_REST_SECONDS");
  return given == nullptr ? usual : std::stod(given);
}

physics::MujocoWorld PhysicsOf(config::Config config, const std::filesystem::path& scene) {
  config.scene = scene;
  return assembly::MakePhysics(&config).world;
}

MotionRig::MotionRig(const config::Config& config, const std::filesystem::path& scene)
    : MotionRig(config, PhysicsOf(config, scene)) {}

MotionRig::MotionRig(const config::Config& config, physics::MujocoWorld world)
    : config_(config), torque_(spec().motors.size()), saturated_(spec().motors.size()) {
  port_.KeepTheLastOnly();

  world_ = assembly::MakeWorld(
      std::move(world), config,
      [this](std::size_t) {
        return emulator::Ports{&port_, &services_};
      },
      &inbox_);
  services_.Call([](authority::MotorOwner*) {});  // the first makes room for all that follow
  world_->Attend({});
}

void MotionRig::Request(std::string_view name, const nlohmann::json& values) {
  auto asked = inbox_.Put(test::RequestOf(name, values));
  world_->Attend({});
  if (const emulator::Answer told = asked->answer.get(); !told) throw std::logic_error(told.why());
}

void MotionRig::Start(std::string_view pose) {
  Request("reset", {{"pose", pose}});
  longest_ = 0;
  Run(1 / spec().rates.service_hz);
}

authority::MotionVerdict MotionRig::Ask(const authority::MotionGoal& goal) {
  authority::MotionVerdict verdict{};
  services_.Call([&](authority::MotorOwner* owner) { verdict = owner->Ask(goal); });
  world_->Attend({});
  return verdict;
}

void MotionRig::Switch(std::string_view alias) {
  services_.Call([&](authority::MotorOwner* owner) { owner->Select(alias); });
  world_->Attend({});
}

bool MotionRig::Run(double seconds) {
  const long ticks = std::lround(seconds / world().timestep());
  for (long i = 0; i < ticks; ++i) {
    if (!Tick()) return false;
  }
  return true;
}

bool MotionRig::RunUntil(int id, double seconds) {
  const long ticks = std::lround(seconds / world().timestep());
  for (long i = 0; i < ticks && state().id != id && Tick(); ++i) continue;
  return state().id == id;
}

bool MotionRig::Push(const Eigen::Vector3d& force, double seconds) {
  Request("push", {{"body", spec().crane_body},
                   {"force", {force.x(), force.y(), force.z()}},
                   {"for", seconds}});
  return Run(seconds);
}

Eigen::Vector3d MotionRig::rpy() const {
  const Eigen::Matrix3d R = world().robot(0).Imu().R_WI.toRotationMatrix();
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)),
          std::atan2(R(1, 0), R(0, 0))};
}

double MotionRig::fastest() const {
  double speed = 0;
  for (const double dq : world().robot(0).dq().first(spec().motors.size())) {
    speed = std::max(speed, std::abs(dq));
  }
  return speed;
}

bool MotionRig::Tick() {
  if (world_->Tick({}) != physics::StepHealth::kFine) return false;
  WatchTorque();
  if (watch) watch();
  return true;
}

void MotionRig::WatchTorque() {
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    const double torque = robot().torque()[i];
    torque_change = std::max(torque_change, std::abs(torque - torque_[i]));
    torque_[i] = torque;
    const bool full = std::abs(torque) >= 0.999 * spec().motors[i].torque_limit;
    saturated_[i] = full ? saturated_[i] + world().timestep() : 0;
    longest_ = std::max(longest_, saturated_[i]);
  }
}

std::vector<std::string> ToldDangers(const MotionRig& rig) {
  std::vector<std::string> told;
  emulator::EventRing::Reader reader(&rig.events());
  for (emulator::Event event; reader.Next(&event);) {
    if (event.kind == emulator::EventKind::kProtection) {
      told.push_back(emulator::ToldEvent{.event = event}.text());
    }
  }
  return told;
}

}  // namespace understudy::motion
