// The state machine of a humanoid's motion service.
#pragma once

#include <string_view>

#include "motion/transitions.h"
#include "robot/motion_spec.h"

namespace understudy::motion {

// The kind of a state.
enum class HumanoidStance : std::uint8_t {
  kZeroTorque,
  kDamping,
  kLockStand,  // joints locked, as in the next two
  kSquat,
  kSit,
  kBalanced,  // on both feet, as in the next one
  kBalancedSquat,
  kWalking,   // by a policy
  kUnplayed,  // of the real robot, not simulated
  kNone,      // no such state
};

inline constexpr StateSet<HumanoidStance> kBearingStances{
    HumanoidStance::kLockStand, HumanoidStance::kSquat, HumanoidStance::kBalanced,
    HumanoidStance::kBalancedSquat, HumanoidStance::kWalking};  // whose feet carry the robot

HumanoidStance StanceOf(const robot::HumanoidMotionSpec& spec, int id);

// Returns the name of such a state, for people; a G1's list of states has most of these words
// (docs/dev/sources.md#g1-states).
std::string_view Name(HumanoidStance stance);

// Returns whether SetFsm may change one state to another, by the vendor's diagram of the G1
// (docs/dev/sources.md#g1-states), which is assumed for all humanoids. While `moving` (an action
// with an end is under way) only damping is reached. kTaken for the present state and, as on
// hardware, for zero torque from states that bear load, which then has no effect.
authority::MotionVerdict MayGo(const robot::HumanoidMotionSpec& spec, int from, int to,
                               bool moving);

}  // namespace understudy::motion
