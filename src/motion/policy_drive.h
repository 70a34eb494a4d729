// A trained policy (room policy) that commands the motors of the body.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "policy/policy.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::motion {

// Steps the policy at its own period and holds its targets in between, as programs that write
// rt/lowcmd do. Motors that the policy does not move hold the standing pose. Allocates only in the
// constructor.
class PolicyDrive {
 public:
  // Reads the definition and its weights for a robot. Throws
  // ConfigError if they do not fit each other or the robot, or if the policy's period is no
  // multiple of the period of the motion service.
  PolicyDrive(const robot::RobotSpec& spec, const std::string& definition);

  // Takes a reading of one instant; the last one counts for Begin and Step.
  void Sense(std::size_t motor, double q, double dq);  // motor order; rad, rad/s
  void Sense(const Eigen::Quaterniond& R_WI, const Eigen::Vector3d& w_WI_I);

  // Commands a velocity until the next call: forward, left m/s, turn rad/s.
  void Ask(const Eigen::Vector3d& velocity) { sensed_.velocity = velocity.cast<float>(); }
  // Whether the commanded velocity is not zero.
  bool asked() const { return !sensed_.velocity.isZero(0); }

  void Begin();
  // Makes one step of dt [s] of the motion service.
  void Step(double dt, robot::RobotCommand* command);

  std::size_t motors() const { return command_.size(); }
  const policy::Policy& policy() const { return policy_; }

 private:
  policy::Policy policy_;
  std::vector<robot::MotorCommand> command_;
  policy::Sensed sensed_;
  long until_due_ = 0;  // steps of the motion service
};

}  // namespace understudy::motion
