// What services, the remote controller and scripts may ask of a motion service: a type per goal,
// with what there is to know of it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <variant>

namespace understudy::authority {
namespace goal {

// The numbers of a call or a chord in the order of its schema; 0 where it has fewer. A bool is 1 or
// 0.
using Numbers = std::array<double, 4>;

// Cut to what ids are; what is no number is -1, which is no id.
inline int Whole(double x) { return x > -1 ? static_cast<int>(std::min(x, 1e6)) : -1; }

// clang-format off
struct ZeroTorque { bool operator==(const ZeroTorque&) const = default; };
struct Damp { bool operator==(const Damp&) const = default; };  // legal in every state
struct StandUp { bool operator==(const StandUp&) const = default; };  // joints locked, no balance
struct StandDown { bool operator==(const StandDown&) const = default; };
struct BalanceStand { bool operator==(const BalanceStand&) const = default; };
struct RecoveryStand { bool operator==(const RecoveryStand&) const = default; };  // however it lies
struct Sit { bool operator==(const Sit&) const = default; };
struct RiseSit { bool operator==(const RiseSit&) const = default; };
struct Hello { bool operator==(const Hello&) const = default; };
struct Stretch { bool operator==(const Stretch&) const = default; };
struct Pose { bool operator==(const Pose&) const = default; };
struct EndPose { bool operator==(const EndPose&) const = default; };
struct StopMove { bool operator==(const StopMove&) const = default; };
struct StopArmAction { bool operator==(const StopArmAction&) const = default; };  // humanoids
// clang-format on

// Of the body.
struct Euler {
  double roll = 0, pitch = 0, yaw = 0;  // rad
  static Euler From(const Numbers& x) { return {x[0], x[1], x[2]}; }
  bool operator==(const Euler&) const = default;
};
struct BodyHeight {
  double height = 0;  // m over the robot's own standing height
  static BodyHeight From(const Numbers& x) { return {x[0]}; }
  bool operator==(const BodyHeight&) const = default;
};
struct AutoRecovery {
  bool on = false;  // gets up by itself after a fall; off, as at the start: stays damped
  static AutoRecovery From(const Numbers& x) { return {x[0] != 0}; }
  bool operator==(const AutoRecovery&) const = default;
};
struct Move {
  double vx = 0, vy = 0;  // m/s, in the body's frame
  double yaw_rate = 0;    // rad/s
  double hold = 0;        // s until it stops by itself
  static Move From(const Numbers& x) { return {x[0], x[1], x[2], x[3]}; }
  bool operator==(const Move&) const = default;
};

// Those below are of humanoids only.
struct SetFsm {
  int id = 0;  // the vendor's, of its state machine
  static SetFsm From(const Numbers& x) { return {Whole(x[0])}; }
  bool operator==(const SetFsm&) const = default;
};
struct SetBalanceMode {
  int mode = 0;  // 0 steps only when needed, 1 keeps stepping
  static SetBalanceMode From(const Numbers& x) { return {Whole(x[0])}; }
  bool operator==(const SetBalanceMode&) const = default;
};
struct SetStandHeight {
  double height = 0;  // 0 lowest to 1 highest
  static SetStandHeight From(const Numbers& x) { return {x[0]}; }
  bool operator==(const SetStandHeight&) const = default;
};
struct ArmAction {
  int id = 0;  // the vendor's
  static ArmAction From(const Numbers& x) { return {Whole(x[0])}; }
  bool operator==(const ArmAction&) const = default;
};

}  // namespace goal

using MotionGoal =
    std::variant<goal::Damp, goal::ZeroTorque, goal::StandUp, goal::StandDown, goal::BalanceStand,
                 goal::RecoveryStand, goal::Sit, goal::RiseSit, goal::Hello, goal::Stretch,
                 goal::Pose, goal::EndPose, goal::Euler, goal::BodyHeight, goal::StopMove,
                 goal::AutoRecovery, goal::Move, goal::SetFsm, goal::SetBalanceMode,
                 goal::SetStandHeight, goal::ArmAction, goal::StopArmAction>;

template <class Goal, class... Goals>
constexpr std::size_t PlaceIn(const std::variant<Goals...>*) {
  std::size_t place = 0;
  (void)((std::is_same_v<Goal, Goals> || (++place, false)) || ...);
  return place;
}

// MotionGoal::index() of that goal.
template <class Goal>
inline constexpr std::size_t kGoal = PlaceIn<Goal>(static_cast<const MotionGoal*>(nullptr));

// Makes a goal of the numbers of a call or a chord.
using GoalMaker = MotionGoal (*)(const goal::Numbers& numbers);

template <class Goal>
MotionGoal To(const goal::Numbers& numbers) {
  if constexpr (std::is_same_v<Goal, goal::Pose>) {
    if (numbers[0] == 0) return goal::EndPose{};  // the vendor's Pose(false)
  }
  if constexpr (std::is_empty_v<Goal>) {
    return Goal{};
  } else {
    return Goal::From(numbers);
  }
}

}  // namespace understudy::authority
