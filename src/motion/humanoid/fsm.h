// Which state a humanoid's motion service goes to from which.
#pragma once

#include "motion/transitions.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

inline constexpr int kZeroTorqueId = 0;  // on every humanoid of the vendor's
inline constexpr int kDampingId = 1;

// What the state with that number is.
enum class HumanoidStance : std::uint8_t {
  kZeroTorque,
  kDamping,
  kLockStand,  // joints held, as in the two that follow
  kSquat,
  kSit,
  kBalanced,  // on both feet, as in the one that follows
  kBalancedSquat,
  kUnplayed,  // the robot has it, nothing here plays it
  kNone,      // no such state
};
inline constexpr StateSet<HumanoidStance> kLockedStances{
    HumanoidStance::kLockStand, HumanoidStance::kSquat, HumanoidStance::kSit};
inline constexpr StateSet<HumanoidStance> kBalancedStances{HumanoidStance::kBalanced,
                                                           HumanoidStance::kBalancedSquat};

HumanoidStance StanceOf(const robot::HumanoidMotionSpec& spec, int id);

// Whether SetFsm may lead from one state to another: the vendor's picture of the G1's transitions
// (docs/sources.md#g1-states), assumed for every humanoid. `moving`: an action with an end is under
// way, then only damping is reached. kTaken for a state the robot is in already and, as on
// hardware, for zero torque from any that bears load, which then does nothing.
authority::MotionVerdict MayGo(const robot::HumanoidMotionSpec& spec, int from, int to,
                               bool moving);

}  // namespace understudy::motion
