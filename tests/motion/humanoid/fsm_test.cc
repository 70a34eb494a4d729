#include "motion/humanoid/fsm.h"

#include <gtest/gtest.h>

#include "tests/motion/rig.h"

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
    EXPECT_EQ(Go(from, 1, true), Verdict::kTaken) << from;
  }
}

TEST(HumanoidFsmTest, LeavesZeroTorqueForDampingOnly) {
  for (const int to : {kReady, kSquat, kSit, kWalk, kCrouch, kRun}) {
    EXPECT_EQ(Go(0, to), Verdict::kNotNow) << to;
  }
}

TEST(HumanoidFsmTest, LeavesDampingForLockedJoints) {
  for (const int to : {0, kReady, kSquat, kSit}) EXPECT_EQ(Go(1, to), Verdict::kTaken) << to;
  EXPECT_EQ(Go(1, kWalk), Verdict::kNotNow);
  EXPECT_EQ(Go(1, kCrouch), authority::MotionVerdict::kUnable);
}

TEST(HumanoidFsmTest, BalancesOnlyFromLockStand) {
  EXPECT_EQ(Go(kReady, kWalk), Verdict::kTaken);
  EXPECT_EQ(Go(kReady, kOldWalk), Verdict::kTaken);
  EXPECT_EQ(Go(kSquat, kWalk), Verdict::kNotNow);
  EXPECT_EQ(Go(kSit, kWalk), Verdict::kNotNow);
  EXPECT_EQ(Go(kCrouch, kWalk), Verdict::kNotNow);
  EXPECT_EQ(Go(kWalk, kOldWalk), Verdict::kTaken);
}

TEST(HumanoidFsmTest, GoesBetweenLockedPosturesAnyWay) {
  for (const int from : {kReady, kSquat, kSit}) {
    for (const int to : {kReady, kSquat, kSit}) EXPECT_EQ(Go(from, to), Verdict::kTaken);
  }
}

TEST(HumanoidFsmTest, DoesNotGoFromBalanceBackToLockStand) {
  EXPECT_EQ(Go(kWalk, kReady), Verdict::kNotNow);
  EXPECT_EQ(Go(kWalk, kSquat), Verdict::kTaken);
  EXPECT_EQ(Go(kWalk, kSit), Verdict::kTaken);
}

TEST(HumanoidFsmTest, LeavesTheBalancedSquatByItselfAndByDampingOnly) {
  EXPECT_EQ(Go(kWalk, kCrouch), Verdict::kTaken);
  EXPECT_EQ(Go(kCrouch, kCrouch), Verdict::kTaken);
  EXPECT_EQ(Go(kReady, kCrouch), Verdict::kNotNow);
  for (const int to : {kReady, kSquat, kSit}) EXPECT_EQ(Go(kCrouch, to), Verdict::kNotNow) << to;
}

TEST(HumanoidFsmTest, RefusesNearlyEverythingWhileItMoves) {
  for (const int to : {kSquat, kSit, kWalk})
    EXPECT_EQ(Go(kReady, to, true), Verdict::kNotNow) << to;
  EXPECT_EQ(Go(kReady, kReady, true), Verdict::kTaken);
  EXPECT_EQ(Go(kCrouch, kCrouch, true), Verdict::kNotNow);
}

TEST(HumanoidFsmTest, IsLedToTheStateOfItsArmsByNoRequest) {
  EXPECT_EQ(StanceOf(G1(), kArms), HumanoidStance::kBalanced);
  EXPECT_EQ(Go(kReady, kArms), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(Go(kWalk, kArms), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(Go(kArms, kSquat), Verdict::kTaken);
}

TEST(HumanoidFsmTest, SaysWhatItCannotPlay) {
  EXPECT_EQ(Go(kReady, kRun), authority::MotionVerdict::kUnable);
  EXPECT_EQ(Go(kWalk, kRun), authority::MotionVerdict::kUnable);
}

TEST(HumanoidFsmTest, WalksFromReadyOrMainControlAndComesToOthersByLockedJoints) {
  robot::HumanoidMotionSpec spec = G1();
  spec.walk = {kWalk, kRun};  // also where it would be balanced or unplayed
  EXPECT_EQ(StanceOf(spec, kWalk), HumanoidStance::kWalking);
  EXPECT_EQ(StanceOf(spec, kRun), HumanoidStance::kWalking);
  for (const int from : {kReady, kOldWalk, kRun}) {
    EXPECT_EQ(MayGo(spec, from, kWalk, false), Verdict::kTaken) << from;
  }
  for (const int from : {0, 1, kSquat, kSit, kCrouch}) {
    EXPECT_EQ(MayGo(spec, from, kWalk, false), Verdict::kNotNow) << from;
  }
  for (const int to : {kReady, kSquat, kSit}) {
    EXPECT_EQ(MayGo(spec, kWalk, to, false), Verdict::kTaken) << to;
    EXPECT_EQ(MayGo(spec, kWalk, to, true), Verdict::kNotNow) << to;
  }
  EXPECT_EQ(MayGo(spec, kWalk, kOldWalk, false), Verdict::kNotNow);
  EXPECT_EQ(MayGo(spec, kWalk, 1, true), Verdict::kTaken);
}

}  // namespace
}  // namespace understudy::motion
