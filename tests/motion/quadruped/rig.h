// A quadruped under its motion service: physics, motors, sensors with their noise, and nothing
// else.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "config/config.h"
#include "motion/quadruped/motion.h"
#include "physics/world.h"
#include "robot/battery.h"
#include "robot/motor.h"
#include "sensors/sensors.h"

namespace understudy::motion {

namespace goal = authority::goal;

class QuadrupedRig {
 public:
  // One of config/robots with the settings ("KEY=VALUE") given, at rest in its lying pose.
  explicit QuadrupedRig(const std::string& robot, const std::vector<std::string>& settings = {},
                        const std::filesystem::path& scene = FlatScene());

  static std::filesystem::path FlatScene();

  // The service starts with the robot at rest in that pose.
  void Start(const robot::PoseSpec& pose);
  void StartLying() { Start(spec().lying); }
  void StartStanding() { Start(spec().standing); }
  // In the stand that Stand Up leads to, and on to a balanced one.
  void StandUp();
  void BalanceStand();

  authority::MotionVerdict Ask(const authority::MotionGoal& goal) { return motion_->Ask(goal); }
  void Run(double seconds);
  // Runs until the service is in that state; false when it is not after `seconds`.
  bool RunUntil(int id, double seconds);
  // A force [N] on the base's origin, in the world, for a time [s].
  void Push(const Eigen::Vector3d& force, double seconds);

  double height() const { return world_.robot().base().p_WB.z(); }
  // Of the base in the world, rad. Yaw counts from the start.
  Eigen::Vector3d rpy() const;
  double tilt() const { return world_.robot().tilt(); }
  double fastest() const;  // rad/s, over all joints
  robot::MotionState state() const { return motion_->state(); }
  // Seconds, of any one motor, that it gave all it has without a break: the longest since Start.
  double longest_saturation() const { return longest_; }

  const robot::RobotSpec& spec() const { return config_.robot; }
  physics::World& world() { return world_; }
  const robot::RobotCommand& command() const { return command_; }
  authority::Motion& motion() { return *motion_; }

  std::function<void()> watch;  // after every step of the service, of what it has seen
  double foot_noise = 0;        // of the service's foot forces, as a share of each

 private:
  void Tick();
  authority::MotionInput Input();

  config::Config config_;
  physics::World world_;
  robot::MotorBank motors_;
  robot::Battery battery_;
  sensors::Sensors sensors_;
  robot::RobotCommand command_;
  robot::RobotState sensed_;
  std::unique_ptr<authority::Motion> motion_;
  std::vector<double> foot_force_;
  std::mt19937 random_{1};
  double time_ = 0;
  Eigen::Vector3d push_{0, 0, 0};
  std::vector<double> saturated_;  // s, by motor
  double longest_ = 0;
};

}  // namespace understudy::motion
