// The goals that services, the remote controller and scripts can give a motion service, one type
// each.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <variant>
#include <vector>

namespace understudy::authority {
namespace goal {

// The numbers of a call or a chord, in order; 0 for missing ones. A bool is 1 or 0.
using Numbers = std::array<double, 4>;

// Truncates and clamps a number to an id; NaN becomes -1, which is no id.
inline int Whole(double x) { return x > -1 ? static_cast<int>(std::min(x, 1e6)) : -1; }

// clang-format off
struct ZeroTorque { bool operator==(const ZeroTorque&) const = default; };
struct Damp { bool operator==(const Damp&) const = default; };  // valid in every state
struct Fall { bool operator==(const Fall&) const = default; };  // it has fallen: damps, until it gets up
struct StandUp { bool operator==(const StandUp&) const = default; };  // joints locked, no balance
struct StandDown { bool operator==(const StandDown&) const = default; };
struct BalanceStand { bool operator==(const BalanceStand&) const = default; };
struct RecoveryStand { bool operator==(const RecoveryStand&) const = default; };  // from any pose
struct Sit { bool operator==(const Sit&) const = default; };
struct RiseSit { bool operator==(const RiseSit&) const = default; };
struct Pose { bool operator==(const Pose&) const = default; };
struct EndPose { bool operator==(const EndPose&) const = default; };
struct StopMove { bool operator==(const StopMove&) const = default; };
struct ResetEstimator { bool operator==(const ResetEstimator&) const = default; };  // its place is 0
struct StopArmAction { bool operator==(const StopArmAction&) const = default; };  // humanoids
// clang-format on

// Of the body.
struct Euler {
  double roll = 0, pitch = 0, yaw = 0;  // rad
  static Euler From(const Numbers& x) { return {x[0], x[1], x[2]}; }
  bool operator==(const Euler&) const = default;
};
struct BodyHeight {
  double height = 0;  // m over the robot's standing height
  static BodyHeight From(const Numbers& x) { return {x[0]}; }
  bool operator==(const BodyHeight&) const = default;
};
// Of the body over the feet, which stay.
struct BodyPosition {
  double x = 0, y = 0, z = 0;  // m ahead, to the left, over the standing height
  double yaw = 0;              // rad
  static BodyPosition From(const Numbers& x) { return {x[0], x[1], x[2], x[3]}; }
  bool operator==(const BodyPosition&) const = default;
};
struct AutoRecovery {
  bool on = false;  // gets up after a fall; off (the default): stays damped
  static AutoRecovery From(const Numbers& x) { return {x[0] != 0}; }
  bool operator==(const AutoRecovery&) const = default;
};
struct Move {
  double vx = 0, vy = 0;   // m/s, in the body's frame
  double yaw_rate = 0;     // rad/s
  double hold = 0;         // s until it stops
  bool by_sticks = false;  // of the remote controller: the speed level scales it
  bool avoids = false;     // stops before obstacles or goes round them
  static Move From(const Numbers& x) { return {x[0], x[1], x[2], x[3]}; }
  bool operator==(const Move&) const = default;
};

// Goals of quadrupeds only.
enum class GestureName : std::uint8_t {
  kHello,
  kStretch,
  kContent,
  kDance1,
  kDance2,
  kScrape,
  kHeart,
  kWiggleHips
};
struct Gesture {
  GestureName name = GestureName::kHello;
  bool operator==(const Gesture&) const = default;
};
enum class GaitName : std::uint8_t {
  kTrot,
  kFree,
  kStatic,
  kRun,
  kEconomic,
  kClassic,
  kFast,
  kStairs,
  kNone
};
struct Gait {
  GaitName name = GaitName::kFree;  // kNone is unknown everywhere
  bool operator==(const Gait&) const = default;
};
struct SpeedLevel {
  int level = 0;  // -1 slow, 0 normal, 1 fast; what is beyond counts as the nearest
  static SpeedLevel From(const Numbers& x) {
    return {static_cast<int>(std::clamp(x[0], -1.0, 1.0))};
  }
  bool operator==(const SpeedLevel&) const = default;
};
struct FootRaise {
  double over = 0;  // m higher than its gait lifts a swinging foot
  static FootRaise From(const Numbers& x) { return {x[0]}; }
  bool operator==(const FootRaise&) const = default;
};
struct KeepStepping {
  bool on = false;  // steps on the spot where it would stand
  static KeepStepping From(const Numbers& x) { return {x[0] != 0}; }
  bool operator==(const KeepStepping&) const = default;
};
struct LastingMoves {
  bool on = false;  // a Move lasts until the next one or StopMove
  static LastingMoves From(const Numbers& x) { return {x[0] != 0}; }
  bool operator==(const LastingMoves&) const = default;
};
struct GoTo {
  double x = 0, y = 0;     // m, by the service's own estimate
  double yaw = 0;          // rad, by the same estimate
  bool from_here = false;  // counts from where the robot is, else from where its estimate began
  bool avoids = false;     // as Move has it
  static GoTo From(const Numbers& x) { return {x[0], x[1], x[2], x[3] != 0}; }
  bool operator==(const GoTo&) const = default;
};
struct PathPoint {
  double t = 0;         // s from the start of the path, ascending
  double x = 0, y = 0;  // m, by the service's own estimate
  double yaw = 0;       // rad, by the same estimate
};
struct FollowPath {
  std::shared_ptr<const std::vector<PathPoint>> points;
  bool operator==(const FollowPath&) const = default;
};

// Goals of humanoids only.
struct SetFsm {
  int id = 0;  // of the vendor's state machine
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
                 goal::RecoveryStand, goal::Sit, goal::RiseSit, goal::Gesture, goal::Pose,
                 goal::EndPose, goal::Euler, goal::BodyHeight, goal::BodyPosition, goal::StopMove,
                 goal::AutoRecovery, goal::Move, goal::Gait, goal::SpeedLevel, goal::FootRaise,
                 goal::KeepStepping, goal::LastingMoves, goal::GoTo, goal::FollowPath,
                 goal::ResetEstimator, goal::SetFsm, goal::SetBalanceMode, goal::SetStandHeight,
                 goal::ArmAction, goal::StopArmAction, goal::Fall>;

template <class Goal, class... Goals>
constexpr std::size_t PlaceIn(const std::variant<Goals...>*) {
  std::size_t place = 0;
  (void)((std::is_same_v<Goal, Goals> || (++place, false)) || ...);
  return place;
}

// The MotionGoal::index() of a goal type.
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

// Makes that goal of any numbers.
template <goal::GestureName name>
MotionGoal To(const goal::Numbers&) {
  return goal::Gesture{name};
}
template <goal::GaitName name>
MotionGoal To(const goal::Numbers&) {
  return goal::Gait{name};
}
// That gait for true and the default one for false.
template <goal::GaitName name>
MotionGoal ToIf(const goal::Numbers& numbers) {
  return goal::Gait{numbers[0] != 0 ? name : goal::GaitName::kFree};
}

}  // namespace understudy::authority
