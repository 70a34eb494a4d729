// A humanoid on flat ground with its own motion service, its motors, its sensors and a crane.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "config/config.h"
#include "motion/humanoid/motion.h"
#include "physics/crane.h"
#include "physics/world.h"
#include "robot/battery.h"
#include "robot/motor.h"
#include "sensors/sensors.h"
#include "tests/support/mujoco_test.h"

namespace understudy::motion {

namespace goal = authority::goal;

// config/robots/<robot>.yaml; "g1 6" is its hardware revision 6.
config::Config HumanoidConfig(const std::string& robot);

class HumanoidRig {
 public:
  // `change_model` may alter the compiled model, as other motors or another floor would.
  explicit HumanoidRig(const std::string& robot,
                       const std::function<void(mjModel&)>& change_model = {},
                       double timestep = 0.001);

  // Puts the robot on the ground standing, or on the crane, and starts the service.
  void Stand();
  void Hang();

  // Step by step for `seconds` of simulated time. False when the physics diverges.
  bool Run(double seconds);
  authority::MotionVerdict Ask(const authority::MotionGoal& goal) { return motion_->Ask(goal); }
  authority::MotionVerdict SetFsm(int id) { return Ask(goal::SetFsm{id}); }
  // From the crane to the ground into the state `id`, the crane gone.
  void SetDown(int id);
  void Push(const Eigen::Vector3d& impulse, double duration = 0.1);  // N·s, at the crane's hook

  bool standing() const {
    return world_.robot().tilt() < 0.4 && height() > 0.75 * spec().standing.height;
  }
  double height() const { return world_.robot().base().p_WB.z(); }
  double Load() const;                // N on the feet
  double DeepestSelfContact() const;  // m, 0 when it does not touch itself
  double FastestJoint() const;        // rad/s
  double q(const std::string& joint) const;

  const robot::RobotSpec& spec() const { return config_.robot; }
  const physics::World& world() const { return world_; }
  physics::Crane& crane() { return crane_; }
  authority::Motion& motion() { return *motion_; }
  int id() const { return motion_->state().id; }

  double torque_change = 0;  // N·m, largest between two steps of any motor since set to 0
  std::function<void(robot::RobotCommand&)> change_command;  // between service and motors
  std::function<void()> watch;                               // after every step

 private:
  void Sense();

  config::Config config_;
  physics::World world_;
  robot::MotorBank motors_;
  robot::Battery battery_;
  sensors::Sensors sensors_;
  physics::Crane crane_{physics::CraneConfig{}};
  std::unique_ptr<authority::Motion> motion_;
  int hook_body_;
  Eigen::Vector3d hook_;
  robot::RobotCommand command_;
  robot::RobotState state_;
  std::vector<double> torque_;
  authority::MotionInput input_;
  Eigen::Vector3d push_{0, 0, 0};
  double push_left_ = 0;
  double time_ = 0;
};

}  // namespace understudy::motion
