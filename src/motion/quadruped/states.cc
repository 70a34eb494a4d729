#include "motion/quadruped/states.h"

#include <array>

namespace understudy::motion {

const QuadrupedStateRow& RowOf(QuadrupedState state) {
  using enum QuadrupedState;
  // In the order of the enum.
  static constexpr std::array kRows{
      QuadrupedStateRow{kDamped, 1001, 7, 0, kDamped},
      QuadrupedStateRow{kFolding, 1002, 6, 0, kRising},
      QuadrupedStateRow{kRising, 1002, 6, 0, kLocked},
      QuadrupedStateRow{kLocked, 1002, 6, 0, kLocked},
      QuadrupedStateRow{kFoldingOn, 1002, 6, 0, kRisingOn},
      QuadrupedStateRow{kRisingOn, 1002, 6, 0, kBalance},
      QuadrupedStateRow{kLowering, 1004, 5, 0, kUnfolding},
      QuadrupedStateRow{kUnfolding, 1004, 5, 0, kLying},
      QuadrupedStateRow{kLying, 1004, 5, 0, kLying},
      QuadrupedStateRow{kBalance, 1013, 1, 0, kBalance},
      QuadrupedStateRow{kHello, 1006, 1, 1, kBalance},
      QuadrupedStateRow{kStretch, 1006, 1, 1, kBalance},
      QuadrupedStateRow{kEndingGesture, 1006, 1, 1, kBalance},
      QuadrupedStateRow{kSittingDown, 1007, 10, 0, kSitting},
      QuadrupedStateRow{kSitting, 1007, 10, 0, kSitting},
      QuadrupedStateRow{kRisingSit, 1006, 1, 1, kBalance},
      QuadrupedStateRow{kPosing, 1091, 2, 0, kPosing},
      QuadrupedStateRow{kRecovering, 2006, 8, 0, kFoldingOn},
      QuadrupedStateRow{kWalking, 100, 3, 0, kBalance},
      QuadrupedStateRow{kDriving, 100, 3, 0, kBalance},
  };
  return kRows[static_cast<std::size_t>(state)];
}

std::span<const QuadrupedTransition> QuadrupedTransitions() {
  using enum QuadrupedState;
  using enum QuadrupedWhen;
  using enum authority::MotionVerdict;
  using authority::kGoal;
  namespace goal = authority::goal;
  static constexpr StateSet<QuadrupedState> kAny{
      kDamped,      kFolding, kRising,  kLocked,     kFoldingOn, kRisingOn,  kLowering,
      kUnfolding,   kLying,   kBalance, kHello,      kStretch,   kRisingSit, kEndingGesture,
      kSittingDown, kSitting, kPosing,  kRecovering, kWalking,   kDriving};
  static constexpr QuadrupedTransition kRows[] = {
      {kGoal<goal::Damp>, kAny, kAlways, kTaken, kDamped},
      {kGoal<goal::AutoRecovery>, kAny, kAlways, kTaken},

      {kGoal<goal::StandUp>, {kDamped, kUnfolding, kLying}, kUpright, kTaken, kFolding},
      {kGoal<goal::StandUp>, {kFolding, kRising, kLocked}, kAlways, kTaken},
      {kGoal<goal::StandUp>, {kFoldingOn}, kAlways, kTaken, kFolding},
      {kGoal<goal::StandUp>, {kRisingOn, kLowering, kBalance, kPosing}, kAlways, kTaken, kRising},

      {kGoal<goal::StandDown>, {kDamped}, kUpright, kTaken, kUnfolding},
      {kGoal<goal::StandDown>, {kLocked}, kAlways, kTaken, kLowering},
      {kGoal<goal::StandDown>, {kBalance, kPosing}, kLegged, kTaken, kLowering},
      {kGoal<goal::StandDown>, {kLowering, kUnfolding, kLying}, kAlways, kTaken},

      {kGoal<goal::BalanceStand>, {kRising, kRisingOn}, kAlways, kTaken, kRisingOn},
      {kGoal<goal::BalanceStand>, {kLocked, kPosing}, kAlways, kTaken, kBalance},
      {kGoal<goal::BalanceStand>, {kBalance}, kAlways, kTaken},

      {kGoal<goal::RecoveryStand>,
       {kDamped, kFolding, kFoldingOn, kLowering, kUnfolding, kLying},
       kAlways,
       kTaken,
       kRecovering},
      {kGoal<goal::RecoveryStand>, {kRecovering}, kAlways, kTaken},
      {kGoal<goal::RecoveryStand>, {kRising, kRisingOn}, kLegged, kTaken, kRisingOn},
      {kGoal<goal::RecoveryStand>, {kLocked, kPosing}, kLegged, kTaken, kBalance},
      {kGoal<goal::RecoveryStand>, {kBalance}, kLegged, kTaken},
      {kGoal<goal::RecoveryStand>, {kSitting}, kLegged, kTaken, kRisingSit},

      {kGoal<goal::Sit>, {kBalance}, kAlways, kTaken, kSittingDown},
      {kGoal<goal::Sit>, {kSitting}, kAlways, kTaken},
      {kGoal<goal::RiseSit>, {kSitting}, kAlways, kTaken, kRisingSit},
      {kGoal<goal::Hello>, {kBalance}, kAlways, kTaken, kHello},
      {kGoal<goal::Stretch>, {kBalance}, kAlways, kTaken, kStretch},
      {kGoal<goal::Pose>, {kBalance, kPosing}, kAlways, kTaken, kPosing},
      {kGoal<goal::EndPose>, {kBalance, kPosing}, kAlways, kTaken, kBalance},
      {kGoal<goal::Euler>, {kBalance, kPosing, kWalking, kDriving}, kAlways, kTaken},
      {kGoal<goal::BodyHeight>, {kBalance, kPosing, kWalking, kDriving}, kAlways, kTaken},

      {kGoal<goal::StopMove>, {kHello, kStretch}, kAlways, kTaken, kEndingGesture},
      {kGoal<goal::StopMove>, {kBalance, kPosing}, kAlways, kTaken, kBalance},
      {kGoal<goal::StopMove>, kAny, kAlways, kTaken},
      // After StandUp taken and without effect, as on a real Go2.
      {kGoal<goal::Move>, {kRising, kRisingOn, kLocked}, kAlways, kTaken},
      {kGoal<goal::Move>, {kBalance, kWalking, kDriving}, kAlways, kTaken},
  };
  return kRows;
}

}  // namespace understudy::motion
