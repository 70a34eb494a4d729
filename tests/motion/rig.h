// A robot under its motion service, in whole ticks of the emulator, without commands at its port.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "authority/motion.h"
#include "config/config.h"
#include "emulator/world.h"
#include "tests/support/fake_port.h"
#include "tests/support/fake_services.h"

namespace understudy::motion {

namespace goal = authority::goal;

inline constexpr double kDegree = std::numbers::pi / 180;  // rad
using Verdict = authority::MotionVerdict;

// One of config/robots with the settings ("KEY=VALUE") given.
config::Config ConfigOf(const std::string& robot, const std::vector<std::string>& settings = {});
std::filesystem::path FlatScene();
// Simulated s for which robots are to rest: UNDERSTUDY_REST_SECONDS if set, else `usual`.
double RestSeconds(double usual);
// The robot of `config` in a scene, and nothing that moves it.
physics::MujocoWorld PhysicsOf(config::Config config,
                               const std::filesystem::path& scene = FlatScene());

class MotionRig {
 public:
  // In the start pose that `config` names.
  explicit MotionRig(const config::Config& config,
                     const std::filesystem::path& scene = FlatScene());
  // The same in a world that was made of it.
  MotionRig(const config::Config& config, physics::MujocoWorld world);

  // A request, carried out at once.
  void Request(std::string_view name, const nlohmann::json& values = {});
  // Puts the robot at rest into a start pose, and the service has seen it there.
  void Start(std::string_view pose);

  authority::MotionVerdict Ask(const authority::MotionGoal& goal);
  // Has the motion service with that alias move the motors.
  void Switch(std::string_view alias);
  // False when the physics diverges.
  bool Run(double seconds);
  // Runs until the service is in that state; false when it is not after `seconds`.
  bool RunUntil(int id, double seconds);
  // Runs under a force [N], world axes, on the body that a crane would lift.
  bool Push(const Eigen::Vector3d& force, double seconds);

  const robot::RobotSpec& spec() const { return config_.robots[0].spec; }
  test::FakePort& port() { return port_; }
  double time() const { return world_->time(); }  // simulated s
  const physics::MujocoWorld& world() const { return world_->physics(); }
  emulator::Robot& robot() { return world_->robot(0); }
  const emulator::EventRing& events() const { return world_->events(); }
  const emulator::Robot& robot() const { return world_->robot(0); }
  robot::MotionState state() const { return robot().owner().state(); }
  const robot::RobotCommand& command() const { return robot().command(); }

  // Of the base: m over the world's origin; rad in the world, yaw from the start; rad off upright.
  double height() const { return world().robot().base().p_WB.z(); }
  Eigen::Vector3d rpy() const;
  double tilt() const { return world().robot().tilt(); }
  double fastest() const;  // rad/s, over the joints of the body
  // Seconds, of any one motor, that it gave all it has without a break: the longest since Start.
  double longest_saturation() const { return longest_; }

  double torque_change = 0;     // N·m, largest between two steps of any motor since set to 0
  std::function<void()> watch;  // after every tick

 private:
  bool Tick();
  void WatchTorque();

  config::Config config_;
  test::FakePort port_;
  test::FakeServices services_;
  emulator::Inbox inbox_;
  std::unique_ptr<emulator::World> world_;
  std::vector<double> torque_;     // N·m, by motor, of the last tick
  std::vector<double> saturated_;  // s, by motor
  double longest_ = 0;
};

// The events so far of what the service protects the robot from, as text.
std::vector<std::string> ToldDangers(const MotionRig& rig);

}  // namespace understudy::motion
