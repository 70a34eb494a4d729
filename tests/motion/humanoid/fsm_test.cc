#include "motion/humanoid/fsm.h"

#include <gtest/gtest.h>

namespace understudy::motion {
namespace {

constexpr int kReady = 4, kSquat = 2, kSit = 3, kWalk = 501, kOldWalk = 200, kCrouch = 706,
              kRun = 802, kArms = 816;

robot::HumanoidMotionSpec G1() {
  robot::HumanoidMotionSpec spec;
  spec.lock_stand = kReady;
  spec.balance = {kWalk, kOldWalk};
  spec.squat = kSquat;
  spec.sit = kSit;
  spec.balanced_squat = kCrouch;
  spec.arms_balance = kArms;
  spec.unplayed = {kRun};
  return spec;
}

authority::MotionVerdict Go(int from, int to, bool moving = false) {
  return MayGo(G1(), from, to, moving);
}

constexpr auto kTaken = authority::MotionVerdict::kTaken;
constexpr auto kNotNow = authority::MotionVerdict::kNotNow;

TEST(HumanoidFsmTest, KnowsEachStateByItsNumber) {
  EXPECT_EQ(StanceOf(G1(), 0), HumanoidStance::kZeroTorque);
  EXPECT_EQ(StanceOf(G1(), 1), HumanoidStance::kDamping);
  EXPECT_EQ(StanceOf(G1(), kReady), HumanoidStance::kLockStand);
  EXPECT_EQ(StanceOf(G1(), kSquat), HumanoidStance::kSquat);
  EXPECT_EQ(StanceOf(G1(), kSit), HumanoidStance::kSit);
  for (const int id : {kWalk, kOldWalk}) {
    EXPECT_EQ(StanceOf(G1(), id), HumanoidStance::kBalanced);
  }
  EXPECT_EQ(StanceOf(G1(), kCrouch), HumanoidStance::kBalancedSquat);
  EXPECT_EQ(StanceOf(G1(), kRun), HumanoidStance::kUnplayed);
  EXPECT_EQ(StanceOf(G1(), 99999), HumanoidStance::kNone);
}

TEST(HumanoidFsmTest, HasNoStateWhereTheRobotHasNone) {
  const robot::HumanoidMotionSpec none;
  for (const int id : {-1, 2, 3, 4, 501, 706, 816}) {
    EXPECT_EQ(StanceOf(none, id), HumanoidStance::kNone) << id;
  }
}

TEST(HumanoidFsmTest, RefusesNumbersNobodyKnows) {
  for (const int from : {0, 1, kReady, kWalk})
    EXPECT_EQ(Go(from, 99999), authority::MotionVerdict::kUnknown);
}

TEST(HumanoidFsmTest, AlwaysTakesDamping) {
  for (const int from : {0, 1, kReady, kSquat, kSit, kWalk, kCrouch}) {
    EXPECT_EQ(Go(from, 1, true), kTaken) << from;
  }
}

TEST(HumanoidFsmTest, LeavesZeroTorqueForDampingOnly) {
  for (const int to : {kReady, kSquat, kSit, kWalk, kCrouch, kRun}) {
    EXPECT_EQ(Go(0, to), kNotNow) << to;
  }
}

TEST(HumanoidFsmTest, LeavesDampingForLockedJoints) {
  for (const int to : {0, kReady, kSquat, kSit}) EXPECT_EQ(Go(1, to), kTaken) << to;
  EXPECT_EQ(Go(1, kWalk), kNotNow);
  EXPECT_EQ(Go(1, kCrouch), authority::MotionVerdict::kUnable);
}

TEST(HumanoidFsmTest, BalancesOnlyFromLockStand) {
  EXPECT_EQ(Go(kReady, kWalk), kTaken);
  EXPECT_EQ(Go(kReady, kOldWalk), kTaken);
  EXPECT_EQ(Go(kSquat, kWalk), kNotNow);
  EXPECT_EQ(Go(kSit, kWalk), kNotNow);
  EXPECT_EQ(Go(kCrouch, kWalk), kNotNow);
  EXPECT_EQ(Go(kWalk, kOldWalk), kTaken);
}

TEST(HumanoidFsmTest, GoesBetweenLockedPosturesAnyWay) {
  for (const int from : {kReady, kSquat, kSit}) {
    for (const int to : {kReady, kSquat, kSit}) EXPECT_EQ(Go(from, to), kTaken);
  }
}

TEST(HumanoidFsmTest, DoesNotGoFromBalanceBackToLockStand) {
  EXPECT_EQ(Go(kWalk, kReady), kNotNow);
  EXPECT_EQ(Go(kWalk, kSquat), kTaken);
  EXPECT_EQ(Go(kWalk, kSit), kTaken);
}

TEST(HumanoidFsmTest, LeavesTheBalancedSquatByItselfAndByDampingOnly) {
  EXPECT_EQ(Go(kWalk, kCrouch), kTaken);
  EXPECT_EQ(Go(kCrouch, kCrouch), kTaken);
  EXPECT_EQ(Go(kReady, kCrouch), kNotNow);
  for (const int to : {kReady, kSquat, kSit}) EXPECT_EQ(Go(kCrouch, to), kNotNow) << to;
}

TEST(HumanoidFsmTest, RefusesNearlyEverythingWhileItMoves) {
  for (const int to : {kSquat, kSit, kWalk}) EXPECT_EQ(Go(kReady, to, true), kNotNow) << to;
  EXPECT_EQ(Go(kReady, kReady, true), kTaken);
  EXPECT_EQ(Go(kCrouch, kCrouch, true), kNotNow);
}

TEST(HumanoidFsmTest, IsLedToTheStateOfItsArmsByNoRequest) {
  EXPECT_EQ(StanceOf(G1(), kArms), HumanoidStance::kBalanced);
  EXPECT_EQ(Go(kReady, kArms), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(Go(kWalk, kArms), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(Go(kArms, kSquat), kTaken);
}

TEST(HumanoidFsmTest, SaysWhatItCannotPlay) {
  EXPECT_EQ(Go(kReady, kRun), authority::MotionVerdict::kUnable);
  EXPECT_EQ(Go(kWalk, kRun), authority::MotionVerdict::kUnable);
}

}  // namespace
}  // namespace understudy::motion
