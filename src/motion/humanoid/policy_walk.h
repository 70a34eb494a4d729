// Walking by a trained policy.
#pragma once

#include <memory>
#include <utility>

#include <Eigen/Core>

#include "motion/humanoid/behaviour.h"
#include "motion/policy_drive.h"

namespace understudy::motion {

// Passes the commanded velocity to the policy, and zero once it has expired.
class PolicyWalk final : public HumanoidBehaviour {
 public:
  explicit PolicyWalk(std::unique_ptr<PolicyDrive> drive) : drive_(std::move(drive)) {}

  void Begin(const HumanoidReading& sensed);
  // Commands forward, left m/s and turn rad/s for `hold` s.
  void Ask(const Eigen::Vector3d& velocity, double hold);

  void Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) override;

  // No velocity is commanded.
  bool over() const override { return !drive_->asked(); }

 private:
  void Sense(const HumanoidReading& sensed);

  std::unique_ptr<PolicyDrive> drive_;
  double counts_for_ = 0;  // s until the command expires
};

}  // namespace understudy::motion
