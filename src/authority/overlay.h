// Blends the commands of rt/arm_sdk and rt/hand_sdk with those that the motors would follow.
#pragma once

#include <array>
#include <cstddef>
#include <span>
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

// Keeps the newest command of a topic, which only some motors follow. A change of the weight acts
// immediately: clients ramp it (unitree_sdk2 g1_arm7_sdk example).
class Overlay {
 public:
  struct Motor {
    std::size_t index = 0;          // in commands, and in what they are blended into
    std::array<double, 2> clamp{};  // q_clamp
    double lock_kd = 0;             // with which it brakes while it is not enabled
  };

  // Commands are to `count` motors, of which `motors` follow. They expire after `timeout` [s]; 0:
  // never.
  Overlay(std::vector<Motor> motors, std::size_t count, double timeout);

  // Takes a command at time t [s] and clamps its weight to 0..1. Refuses one with another number of
  // motors, with harmful values (HarmIn) or a weight that is not finite. Returns the reason, or
  // kNone.
  robot::Refusal Offer(const robot::RobotCommand& command, double t);
  void Clear() { weight_ = 0; }

  // Returns the effective weight at time t [s].
  double weight(double t) const;
  // Blends it into the commands of all `count` motors, in joint space, at time t [s].
  void MixOver(double t, std::span<robot::MotorCommand> motors) const;

 private:
  std::vector<Motor> motors_;
  double timeout_;
  robot::RobotCommand command_;
  double weight_ = 0;
  double at_ = 0;
};

// rt/arm_sdk: the body's motors in ArmSdkSpec::slots follow.
Overlay OverArms(const robot::RobotSpec& spec);
// rt/hand_sdk: of the motors of all hands, those of hands with an sdk_slot follow.
Overlay OverHands(const robot::RobotSpec& spec);

}  // namespace understudy::authority
