// rt/arm_sdk: commands for some joints, mixed over those of the motion service.
#pragma once

#include <vector>

#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::authority {

// The command under which a motor gives `weight` of the torque of `over` and the rest of that of
// `under`, whatever its angle and rate. Exact: the sum of two lines is a line. A disabled command
// gives none.
robot::MotorCommand Mix(const robot::MotorCommand& under, const robot::MotorCommand& over,
                        double weight);

// Keeps the newest command of rt/arm_sdk. Only the motors of ArmSdkSpec::slots follow it. The
// weight counts at once, as does its end: clients ramp it themselves (unitree_sdk2 g1_arm7_sdk
// example).
class ArmOverlay {
 public:
  explicit ArmOverlay(const robot::RobotSpec& spec);

  // A command of time t [s]; its weight is cut to 0..1. One that would harm (HarmIn), or whose
  // weight is not finite, is left out; returns why, or kNone.
  robot::Refusal Offer(const robot::RobotCommand& command, double t);
  void Clear() { weight_ = 0; }

  // The weight that counts at time t [s].
  double weight(double t) const;
  // Mixes it over `command`, which is in joint space.
  void MixOver(double t, robot::RobotCommand* command) const;

 private:
  std::vector<std::size_t> motors_;
  double timeout_;
  robot::RobotCommand command_;
  double weight_ = 0;
  double at_ = 0;
};

}  // namespace understudy::authority
