// Walking by a trained policy.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "authority/motion.h"
#include "motion/policy_drive.h"
#include "motion/quadruped/behaviour.h"

namespace understudy::motion {

// Passes the commanded velocity to the policy. It is over once no velocity is commanded and the
// robot stands still on its feet, or kLongestStop later.
class PolicyGait final : public Behaviour {
 public:
  explicit PolicyGait(std::unique_ptr<PolicyDrive> drive)
      : drive_(std::move(drive)),
        command_{.motors = std::vector<robot::MotorCommand>(drive_->motors())} {}

  // Takes the sensors of this step; call it before Begin and Step.
  void Sense(const authority::MotionInput& input);

  void Begin();
  void Ask(const Eigen::Vector3d& velocity) { drive_->Ask(velocity); }
  void KeepStepping(bool on) { keeps_stepping_ = on; }

  // Sets the angles of the legs to the policy's targets.
  void Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) override;
  // The command to all motors as of the last Step, with the policy's gains.
  const robot::RobotCommand& command() const { return command_; }

  bool over() const override { return over_; }

 private:
  std::unique_ptr<PolicyDrive> drive_;
  robot::RobotCommand command_;
  double idle_ = 0;  // s without a command
  bool keeps_stepping_ = false;
  bool over_ = false;
};

}  // namespace understudy::motion
