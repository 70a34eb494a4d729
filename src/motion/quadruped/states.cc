#include "motion/quadruped/states.h"

#include <array>

namespace understudy::motion {

const QuadrupedStateRow& RowOf(QuadrupedState state) {
  using enum QuadrupedState;
  // In the order of the enum.
  static constexpr std::array kRows{
      QuadrupedStateRow{kDamped, "damping", 1001, 7, 0, kDamped},
      QuadrupedStateRow{kFolding, "standing up", 1002, 3, 0, kRising},
      QuadrupedStateRow{kRising, "standing up", 1002, 3, 0, kLocked},
      QuadrupedStateRow{kLocked, "standing, joints locked", 1002, 6, 0, kLocked},
      QuadrupedStateRow{kFoldingOn, "standing up", 1002, 3, 0, kRisingOn},
      QuadrupedStateRow{kRisingOn, "standing up", 1002, 3, 0, kStanding},
      QuadrupedStateRow{kLowering, "lying down", 1004, 5, 0, kUnfolding},
      QuadrupedStateRow{kUnfolding, "lying down", 1004, 5, 0, kLying},
      QuadrupedStateRow{kLying, "lying", 1004, 5, 0, kLying},
      QuadrupedStateRow{kStanding, "standing", 100, 1, 0, kStanding},
      QuadrupedStateRow{kBalance, "balanced stand", 1013, 1, 0, kBalance},
      QuadrupedStateRow{kGesturing, "gesture", 1006, 1, 1, kStanding},
      QuadrupedStateRow{kEndingGesture, "gesture", 1006, 1, 1, kStanding},
      QuadrupedStateRow{kSittingDown, "sitting down", 1007, 10, 0, kSitting},
      QuadrupedStateRow{kSitting, "sitting", 1007, 10, 0, kSitting},
      QuadrupedStateRow{kRisingSit, "rising from sitting", 1006, 1, 1, kStanding},
      QuadrupedStateRow{kPosing, "posing", 1091, 2, 0, kPosing},
      QuadrupedStateRow{kRecovering, "recovering", 2006, 8, 0, kFoldingOn},
      QuadrupedStateRow{kWalking, "walking", 100, 3, 0, kStanding},
      QuadrupedStateRow{kDriving, "driving", 100, 3, 0, kStanding},
  };
  return kRows[static_cast<std::size_t>(state)];
}

QuadrupedState EndOf(QuadrupedState state) {
  while (RowOf(state).next != state) state = RowOf(state).next;
  return state;
}

std::span<const QuadrupedTransition> QuadrupedTransitions() {
  using enum QuadrupedState;
  using enum QuadrupedWhen;
  using enum authority::MotionVerdict;
  using authority::kGoal;
  namespace goal = authority::goal;
  static constexpr StateSet<QuadrupedState> kAny{
      kDamped,    kFolding,     kRising,   kLocked,     kFoldingOn, kRisingOn,      kLowering,
      kUnfolding, kLying,       kStanding, kBalance,    kGesturing, kEndingGesture, kRisingSit,
      kSitting,   kSittingDown, kPosing,   kRecovering, kWalking,   kDriving};
  // In which the legs carry the robot, or are about to.
  static constexpr StateSet<QuadrupedState> kHeld{
      kFolding,   kRising,  kLocked,      kFoldingOn, kRisingOn,  kLowering,
      kUnfolding, kLying,   kStanding,    kBalance,   kGesturing, kEndingGesture,
      kRisingSit, kSitting, kSittingDown, kPosing,    kWalking,   kDriving};
  static constexpr QuadrupedTransition kRows[] = {
      {kGoal<goal::Damp>, kAny, kAlways, kTaken, kDamped},
      {kGoal<goal::Fall>, kHeld, kAlways, kTaken, kDamped},
      {kGoal<goal::AutoRecovery>, kAny, kAlways, kTaken},
      {kGoal<goal::SpeedLevel>, kAny, kAlways, kTaken},
      {kGoal<goal::FootRaise>, kAny, kAlways, kTaken},
      {kGoal<goal::KeepStepping>, kAny, kAlways, kTaken},
      {kGoal<goal::LastingMoves>, kAny, kAlways, kTaken},

      {kGoal<goal::StandUp>, {kDamped, kUnfolding, kLying}, kUpright, kTaken, kFolding},
      {kGoal<goal::StandUp>, {kFolding, kRising, kLocked}, kAlways, kTaken},
      {kGoal<goal::StandUp>, {kFoldingOn}, kAlways, kTaken, kFolding},
      {kGoal<goal::StandUp>,
       {kRisingOn, kLowering, kStanding, kBalance, kPosing},
       kAlways,
       kTaken,
       kRising},

      {kGoal<goal::StandDown>, {kDamped}, kUpright, kTaken, kUnfolding},
      {kGoal<goal::StandDown>, {kLocked}, kAlways, kTaken, kLowering},
      {kGoal<goal::StandDown>, {kStanding, kBalance, kPosing}, kLegged, kTaken, kLowering},
      {kGoal<goal::StandDown>, {kLowering, kUnfolding, kLying}, kAlways, kTaken},

      {kGoal<goal::BalanceStand>, {kFolding, kFoldingOn}, kAlways, kTaken, kFoldingOn},
      {kGoal<goal::BalanceStand>, {kRising, kRisingOn}, kAlways, kTaken, kRisingOn},
      {kGoal<goal::BalanceStand>, {kLocked, kPosing, kStanding}, kAlways, kTaken, kBalance},
      {kGoal<goal::BalanceStand>, {kBalance}, kAlways, kTaken},

      {kGoal<goal::RecoveryStand>,
       {kDamped, kFolding, kFoldingOn, kLowering, kUnfolding, kLying},
       kAlways,
       kTaken,
       kRecovering},
      {kGoal<goal::RecoveryStand>, {kRecovering}, kAlways, kTaken},
      {kGoal<goal::RecoveryStand>, {kRising, kRisingOn}, kLegged, kTaken, kRisingOn},
      {kGoal<goal::RecoveryStand>, {kLocked, kPosing, kBalance}, kLegged, kTaken, kStanding},
      {kGoal<goal::RecoveryStand>, {kStanding}, kLegged, kTaken},
      {kGoal<goal::RecoveryStand>, {kSitting}, kLegged, kTaken, kRisingSit},

      {kGoal<goal::Sit>, {kStanding, kBalance}, kAlways, kTaken, kSittingDown},
      {kGoal<goal::Sit>, {kSitting}, kAlways, kTaken},
      {kGoal<goal::RiseSit>, {kSitting}, kAlways, kTaken, kRisingSit},
      {kGoal<goal::Gesture>, {kStanding, kBalance}, kAlways, kTaken, kGesturing},
      {kGoal<goal::Pose>, {kStanding, kBalance, kPosing}, kAlways, kTaken, kPosing},
      {kGoal<goal::EndPose>, {kStanding, kBalance, kPosing}, kAlways, kTaken, kStanding},
      {kGoal<goal::Euler>, {kStanding, kBalance, kPosing, kWalking, kDriving}, kAlways, kTaken},
      {kGoal<goal::BodyHeight>,
       {kStanding, kBalance, kPosing, kWalking, kDriving},
       kAlways,
       kTaken},
      {kGoal<goal::BodyPosition>, {kStanding, kBalance, kPosing}, kAlways, kTaken},
      {kGoal<goal::ResetEstimator>, {kLocked, kStanding, kBalance, kPosing}, kAlways, kTaken},

      // A gait frees the joints of a robot that stands locked, as seen on a Go2.
      {kGoal<goal::Gait>, {kFolding, kFoldingOn}, kAlways, kTaken, kFoldingOn},
      {kGoal<goal::Gait>, {kRising, kRisingOn}, kAlways, kTaken, kRisingOn},
      {kGoal<goal::Gait>, {kLocked, kBalance, kPosing}, kAlways, kTaken, kStanding},
      {kGoal<goal::Gait>, {kStanding, kWalking, kDriving}, kAlways, kTaken},

      {kGoal<goal::StopMove>, {kGesturing}, kAlways, kTaken, kEndingGesture},
      {kGoal<goal::StopMove>, {kStanding, kBalance, kPosing}, kAlways, kTaken, kStanding},
      {kGoal<goal::StopMove>, kAny, kAlways, kTaken},
      // After StandUp, as on a real Go2.
      {kGoal<goal::Move>, {kRising, kRisingOn, kLocked}, kAlways, kIgnored},
      {kGoal<goal::Move>, {kStanding, kBalance, kWalking, kDriving}, kAlways, kTaken},
      {kGoal<goal::GoTo>, {kStanding, kBalance, kWalking, kDriving}, kAlways, kTaken},
      {kGoal<goal::FollowPath>, {kStanding, kBalance, kWalking, kDriving}, kAlways, kTaken},
  };
  return kRows;
}

}  // namespace understudy::motion
