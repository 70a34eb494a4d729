// Tests what differs between quadrupeds, or is known of one of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "motion/quadruped/motion.h"
#include "tests/motion/quadruped/rig.h"
#include "tests/support/allocations.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

// The vendor's page of the Go2-W.
class WheeledMotionTest : public testing::TestWithParam<std::string> {
 protected:
  QuadrupedRig rig_{GetParam()};
};

TEST_P(WheeledMotionTest, LiesDownFromLockOrDampingOnly) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.Ask(goal::StandDown{}), authority::MotionVerdict::kNotNow);
  EXPECT_EQ(rig_.Ask(goal::StandUp{}), authority::MotionVerdict::kTaken);
  rig_.Run(2);
  EXPECT_EQ(rig_.Ask(goal::StandDown{}), authority::MotionVerdict::kTaken);
  rig_.Run(4);
  for (const robot::MotorCommand& motor : rig_.command().motors) {
    EXPECT_EQ(motor.kp, 0) << "idle";
    EXPECT_EQ(motor.kd, 0);
  }
  EXPECT_EQ(rig_.Ask(goal::Damp{}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(rig_.Ask(goal::StandDown{}), authority::MotionVerdict::kTaken);
}

TEST_P(WheeledMotionTest, RecoversFromDampingOrLyingOnly) {
  rig_.StandUp();
  EXPECT_EQ(rig_.Ask(goal::RecoveryStand{}), authority::MotionVerdict::kNotNow);
  rig_.Ask(goal::Damp{});
  rig_.Run(2);
  EXPECT_EQ(rig_.Ask(goal::RecoveryStand{}), authority::MotionVerdict::kTaken);
}

INSTANTIATE_TEST_SUITE_P(Robots, WheeledMotionTest, testing::ValuesIn(test::WheeledRobots()),
                         [](const auto& test) { return test.param; });

class Go2MotionTest : public testing::Test {
 protected:
  QuadrupedRig rig_{"go2"};
};

TEST_F(Go2MotionTest, SaysAllByAnglesAsTheRealOneDoes) {
  rig_.BalanceStand();
  for (const robot::MotorCommand& motor : rig_.command().motors) {
    EXPECT_EQ(motor.kp, 40);
    EXPECT_EQ(motor.kd, 1);
    EXPECT_EQ(motor.dq, 0);
    EXPECT_EQ(motor.tau, 0);
  }
}

// docs/dev/sources.md#go2-captures: 0.78 to 0.82 and -1.43 to -1.48 rad in a lock, hips within
// 0.06.
TEST_F(Go2MotionTest, LocksInThePoseThatWasSeen) {
  rig_.StandUp();
  for (std::size_t i = 0; i < 12; i += 3) {
    EXPECT_NEAR(rig_.world().robot().q()[i], 0, 0.06);
    EXPECT_NEAR(rig_.world().robot().q()[i + 1], 0.80, 0.08);
    EXPECT_NEAR(rig_.world().robot().q()[i + 2], -1.455, 0.1) << "0.33 m is a little lower";
  }
}

TEST_F(Go2MotionTest, DoesNotMoveAfterStandUpUntilItBalances) {
  rig_.Start("lying");
  EXPECT_EQ(rig_.Ask(goal::Move{0.3}), authority::MotionVerdict::kNotNow);
  rig_.StandUp();
  const double x = rig_.world().robot().base().p_WB.x();
  EXPECT_EQ(rig_.Ask(goal::Move{0.3, 0, 0, 1}), authority::MotionVerdict::kIgnored);
  rig_.Run(1);
  EXPECT_NEAR(rig_.world().robot().base().p_WB.x(), x, 0.01);
  EXPECT_EQ(rig_.state().id, kLocked);
  rig_.Ask(goal::BalanceStand{});
  rig_.Run(2);
  EXPECT_EQ(rig_.Ask(goal::Move{0.5, 0, 0, 1}), authority::MotionVerdict::kTaken);
  rig_.Run(2);
  EXPECT_GT(rig_.world().robot().base().p_WB.x(), x + 0.2);
}

// Its only way up of a product for navigation (tinynav): both orders at once.
TEST_F(Go2MotionTest, BalancesAfterStandUpAndAtOnceBalanceStand) {
  for (const double later : {0.0, 0.3, 1.2}) {  // s: as it folds its legs, and as it rises
    rig_.Start("lying");
    rig_.Run(0.2);
    EXPECT_EQ(rig_.Ask(goal::StandUp{}), authority::MotionVerdict::kTaken);
    rig_.Run(later);
    EXPECT_EQ(rig_.Ask(goal::BalanceStand{}), authority::MotionVerdict::kTaken);
    EXPECT_TRUE(rig_.RunUntil(kBalance, 4)) << later;
  }
}

TEST_F(Go2MotionTest, DoesOnceItStandsWhatItIsAskedForOnTheWay) {
  rig_.Start("lying");
  rig_.Run(0.2);
  EXPECT_EQ(rig_.Ask(goal::StandUp{}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(rig_.Ask(goal::StandDown{}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(rig_.RunUntil(kLocked, 1)) << "it is rising";
  rig_.Run(6);
  EXPECT_LT(rig_.height(), 0.15) << "it lies again";

  EXPECT_EQ(rig_.Ask(goal::RecoveryStand{}), authority::MotionVerdict::kTaken);
  ASSERT_TRUE(rig_.RunUntil(kLocked, 8)) << "it is rising to a balanced stand";
  EXPECT_EQ(rig_.Ask(goal::Gesture{}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(rig_.RunUntil(kGesture, 8));
}

// The whole of a course's program that makes the dog sit (Dylan-vrl/com304-go2), and of one that
// greets: each order a second after the last, while it still rises.
TEST_F(Go2MotionTest, SitsAndGreetsAfterStandUpAlone) {
  for (const auto& [order, id] :
       {std::pair{authority::MotionGoal(goal::Sit{}), int{kSit}},
        std::pair{authority::MotionGoal(goal::Gesture{}), int{kGesture}}}) {
    rig_.Start("lying");
    rig_.Run(0.2);
    EXPECT_EQ(rig_.Ask(goal::StandUp{}), authority::MotionVerdict::kTaken);
    rig_.Run(1);
    EXPECT_EQ(rig_.Ask(order), authority::MotionVerdict::kTaken);
    EXPECT_TRUE(rig_.RunUntil(id, 4));
    EXPECT_TRUE(id == kSit || rig_.RunUntil(kBalance, 10)) << "so it may walk";
  }
}

TEST_F(Go2MotionTest, RisesOutOfASitThatItIsStillOnItsWayTo) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.Ask(goal::Sit{}), authority::MotionVerdict::kTaken);
  rig_.Run(0.5);
  EXPECT_EQ(rig_.Ask(goal::Gesture{}), authority::MotionVerdict::kNotNow);
  EXPECT_EQ(rig_.Ask(goal::RiseSit{}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(rig_.state().id, kSit) << "it sits first";
  EXPECT_EQ(rig_.state().mode, 10);
  EXPECT_TRUE(rig_.RunUntil(kGesture, 3)) << "it rises";
  EXPECT_EQ(rig_.Ask(goal::StandDown{}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(rig_.RunUntil(kCrouch, 4)) << "it stands, and lies down";
}

TEST_F(Go2MotionTest, DoesInAPostureWhatThatAllows) {
  const authority::MotionGoal kSpecial[] = {goal::Gesture{}, goal::Sit{}, goal::Pose{},
                                            goal::Euler{1}, goal::BodyHeight{1}};
  rig_.Start("lying");
  for (const authority::MotionGoal& action : kSpecial) {
    EXPECT_EQ(rig_.Ask(action), authority::MotionVerdict::kNotNow) << "lying";
  }
  EXPECT_EQ(rig_.Ask(goal::BalanceStand{}), authority::MotionVerdict::kNotNow);
  EXPECT_EQ(rig_.Ask(goal::RiseSit{}), authority::MotionVerdict::kNotNow);
  rig_.StandUp();
  for (const authority::MotionGoal& action :
       {authority::MotionGoal(goal::Euler{1}), authority::MotionGoal(goal::BodyHeight{1})}) {
    EXPECT_EQ(rig_.Ask(action), authority::MotionVerdict::kNotNow) << "locked";
  }
  rig_.BalanceStand();
  EXPECT_EQ(rig_.Ask(goal::Gesture{goal::GestureName::kStretch}), authority::MotionVerdict::kTaken);
  for (const authority::MotionGoal& action : kSpecial) {
    EXPECT_EQ(rig_.Ask(action), authority::MotionVerdict::kNotNow) << "before the last has ended";
  }
  EXPECT_EQ(rig_.Ask(goal::StandUp{}), authority::MotionVerdict::kNotNow);
  EXPECT_EQ(rig_.Ask(goal::Damp{}), authority::MotionVerdict::kTaken);
}

TEST_F(Go2MotionTest, FollowsAnglesThatChangeAllTheTime) {
  rig_.BalanceStand();
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const double t = 0.01 * i;
    rig_.Ask(goal::Euler{0, 0.3 * std::sin(2 * t), 0});
    rig_.Run(0.01);
    // A critically damped follower of 8 rad/s lags a slow wave by 2/8 s.
    if (t > 1) worst = std::max(worst, std::abs(rig_.rpy()[1] - 0.3 * std::sin(2 * (t - 0.25))));
  }
  EXPECT_LT(worst, 0.06);
}

TEST_F(Go2MotionTest, CarriesALoadLevelAndAtItsHeight) {
  rig_.BalanceStand();
  rig_.Push(Vector3d(0, 0, -40), 8);
  EXPECT_NEAR(rig_.height(), 0.33, 0.01);
  EXPECT_LT(rig_.tilt(), kDegree);
}

TEST_F(Go2MotionTest, StepAllocatesNothing) {
  rig_.Start("lying");
  const authority::MotionGoal kWay[] = {goal::StandUp{}, goal::BalanceStand{}, goal::Gesture{},
                                        goal::Damp{}, goal::RecoveryStand{}};
  for (const authority::MotionGoal& action : kWay) {
    const std::uint64_t before = test::Allocations();
    rig_.Ask(action);
    rig_.Run(4);
    EXPECT_EQ(test::Allocations(), before);
  }
}

TEST(Go2LongStandTest, StandsAMinuteLockedAndBalanced) {
  QuadrupedRig rig("go2", {"physics.timestep=0.002"});
  for (const bool balanced : {false, true}) {
    balanced ? rig.BalanceStand() : rig.StandUp();
    const Vector3d before = rig.world().robot().base().p_WB;
    rig.Run(30);
    EXPECT_LT((rig.world().robot().base().p_WB - before).norm(), 0.02);
    EXPECT_LT(rig.tilt(), 2 * kDegree);
    EXPECT_LT(rig.longest_saturation(), 0.05);
  }
}

TEST(PoweredRobotTest, AGo2LiesLimpUntilItHasBootedAndStandsUpByItself) {
  QuadrupedRig rig("go2", {"robot.boot={states: 1, services: 1.2, motion: 2}", "start.boot=true"});
  rig.Run(1.5);
  EXPECT_EQ(rig.state().id, 0) << "no motion service";
  EXPECT_LT(rig.height(), 0.15);
  EXPECT_EQ(*std::ranges::max_element(rig.robot().torque()), 0);
  rig.Run(6);
  EXPECT_EQ(rig.state().name, "standing");
  EXPECT_GT(rig.height(), 0.28);
}

}  // namespace
}  // namespace understudy::motion
