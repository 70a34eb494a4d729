// Blends the commands of rt/arm_sdk with those of the motion service.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::authority {

// Returns the command whose torque is `weight` times that of `over` plus 1 - `weight` times that of
// `under`, at every angle and rate. Its gains are the weighted sums of both, its q and dq the means
// weighted by those gains: so the torque is exact for a motor that scales gains (MotorSpec,
// kd_share) and keeps angles within `clamp` (q_clamp), too. A disabled command has no torque.
robot::MotorCommand Mix(const robot::MotorCommand& under, const robot::MotorCommand& over,
                        double weight, const std::array<double, 2>& clamp);

// Keeps the newest command of rt/arm_sdk, which only the motors of ArmSdkSpec::slots follow. A
// change of the weight acts immediately: clients ramp it (unitree_sdk2 g1_arm7_sdk example).
class ArmOverlay {
 public:
  explicit ArmOverlay(const robot::RobotSpec& spec);

  // Takes a command at time t [s] and clamps its weight to 0..1. Refuses one with another number of
  // motors than the body's, with harmful values (HarmIn) or a weight that is not finite. Returns
  // the reason, or kNone.
  robot::Refusal Offer(const robot::RobotCommand& command, double t);
  void Clear() { weight_ = 0; }

  // Returns the effective weight at time t [s].
  double weight(double t) const;
  // Blends it into `command`, which is in joint space, at time t [s].
  void MixOver(double t, robot::RobotCommand* command) const;

 private:
  struct Motor {
    std::size_t index;
    std::array<double, 2> clamp;  // q_clamp
  };

  std::vector<Motor> motors_;
  double timeout_;
  robot::RobotCommand command_;
  double weight_ = 0;
  double at_ = 0;
};

}  // namespace understudy::authority
