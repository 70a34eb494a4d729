// Blends the commands of rt/arm_sdk with those of the motion service.
#pragma once

#include <vector>

#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::authority {

// Returns the command whose torque is `weight` times that of `over` plus 1 - `weight` times that of
// `under`, at every angle and rate. This is exact, since both torques are linear in angle and rate.
// A disabled command has no torque.
robot::MotorCommand Mix(const robot::MotorCommand& under, const robot::MotorCommand& over,
                        double weight);

// Keeps the newest command of rt/arm_sdk, which only the motors of ArmSdkSpec::slots follow. A
// change of the weight acts immediately: clients ramp it (unitree_sdk2 g1_arm7_sdk example).
class ArmOverlay {
 public:
  explicit ArmOverlay(const robot::RobotSpec& spec);

  // Takes a command at time t [s] and clamps its weight to 0..1. Refuses one with harmful values
  // (HarmIn) or a weight that is not finite. Returns the reason, or kNone.
  robot::Refusal Offer(const robot::RobotCommand& command, double t);
  void Clear() { weight_ = 0; }

  // Returns the effective weight at time t [s].
  double weight(double t) const;
  // Blends it into `command`, which is in joint space, at time t [s].
  void MixOver(double t, robot::RobotCommand* command) const;

 private:
  std::vector<std::size_t> motors_;
  double timeout_;
  robot::RobotCommand command_;
  double weight_ = 0;
  double at_ = 0;
};

}  // namespace understudy::authority
