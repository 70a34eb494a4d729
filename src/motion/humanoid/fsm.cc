#include "motion/humanoid/fsm.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace understudy::motion {
namespace {

bool Has(const std::vector<int>& ids, int id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

enum class HumanoidWhen : std::uint8_t {
  kAlways,
  kStill,  // no action with an end is under way
  kSame,   // it is the present state
};
using HumanoidTransition = Transition<HumanoidStance, HumanoidStance, HumanoidWhen>;

std::span<const HumanoidTransition> HumanoidTransitions() {
  using enum HumanoidStance;
  using enum HumanoidWhen;
  using enum authority::MotionVerdict;
  static constexpr StateSet<HumanoidStance> kAny{kZeroTorque,    kDamping, kLockStand,
                                                 kSquat,         kSit,     kBalanced,
                                                 kBalancedSquat, kWalking, kUnplayed};

  static constexpr HumanoidTransition kRows[] = {
      {kZeroTorque, kAny, kAlways, kTaken, kZeroTorque},
      {kDamping, kAny, kAlways, kTaken, kDamping},

      {kLockStand, {kLockStand}, kSame, kTaken},
      {kLockStand, {kDamping, kSquat, kSit, kWalking}, kStill, kTaken, kLockStand},
      {kSquat, {kSquat}, kSame, kTaken},
      {kSquat, {kDamping, kLockStand, kSit, kBalanced, kWalking}, kStill, kTaken, kSquat},
      {kSit, {kSit}, kSame, kTaken},
      {kSit, {kDamping, kLockStand, kSquat, kBalanced, kWalking}, kStill, kTaken, kSit},

      {kBalanced, {kBalanced}, kSame, kTaken},
      {kBalanced, {kLockStand, kBalanced}, kStill, kTaken, kBalanced},
      {kBalancedSquat, {kBalanced, kBalancedSquat}, kStill, kTaken, kBalancedSquat},
      // The robot would have to rise from its squat on the ground, which is not simulated.
      {kBalancedSquat, {kDamping}, kStill, kUnable},

      // From walking a robot comes to the other states by locked joints (*assumed*).
      {kWalking, {kWalking}, kAlways, kTaken, kWalking},
      {kWalking, {kLockStand, kBalanced}, kStill, kTaken, kWalking},

      {kUnplayed,
       {kDamping, kLockStand, kSquat, kSit, kBalanced, kBalancedSquat, kWalking},
       kStill,
       kUnable},
  };
  return kRows;
}

}  // namespace

std::string_view Name(HumanoidStance stance) {
  // In the order of the enum.
  static constexpr std::array<std::string_view, 10> kNames{
      "zero torque",  "damping",        "ready",   "squat",        "seat",
      "main control", "balanced squat", "walking", "not modelled", "unknown"};
  return kNames[static_cast<std::size_t>(stance)];
}

HumanoidStance StanceOf(const robot::HumanoidMotionSpec& spec, int id) {
  if (id == robot::kZeroTorqueId) return HumanoidStance::kZeroTorque;
  if (id == robot::kDampingId) return HumanoidStance::kDamping;
  if (id < 0) return HumanoidStance::kNone;
  if (id == spec.lock_stand) return HumanoidStance::kLockStand;
  if (id == spec.squat) return HumanoidStance::kSquat;
  if (id == spec.sit) return HumanoidStance::kSit;
  if (id == spec.balanced_squat) return HumanoidStance::kBalancedSquat;
  if (Has(spec.walk, id)) return HumanoidStance::kWalking;
  if (Has(spec.balance, id) || id == spec.arms_balance) return HumanoidStance::kBalanced;
  return Has(spec.unplayed, id) ? HumanoidStance::kUnplayed : HumanoidStance::kNone;
}

authority::MotionVerdict MayGo(const robot::HumanoidMotionSpec& spec, int from, int to,
                               bool moving) {
  // Arms lead to that state, no request does.
  const HumanoidStance wanted =
      to >= 0 && to == spec.arms_balance && to != from ? HumanoidStance::kNone : StanceOf(spec, to);
  if (wanted == HumanoidStance::kNone) return authority::MotionVerdict::kUnknown;
  const HumanoidTransition* row =
      Find(HumanoidTransitions(), wanted, StanceOf(spec, from), [&](HumanoidWhen when) {
        return when == HumanoidWhen::kAlways ||
               (when == HumanoidWhen::kSame ? to == from : !moving);
      });
  return row == nullptr ? authority::MotionVerdict::kNotNow : row->verdict;
}

}  // namespace understudy::motion
