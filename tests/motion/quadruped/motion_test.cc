#include "motion/quadruped/motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/motion/quadruped/rig.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

class QuadrupedMotionTest : public testing::TestWithParam<std::string> {
 protected:
  QuadrupedMotionTest() : rig_(GetParam()) {}

  const robot::QuadrupedMotionSpec& figures() const { return rig_.spec().motion.quadruped; }
  double stand() const { return figures().stand_height; }
  void ExpectStandsLevel(double tolerance = 2 * kDegree) {
    EXPECT_NEAR(rig_.height(), stand(), 0.02);
    EXPECT_LT(rig_.tilt(), tolerance);
    EXPECT_LT(rig_.fastest(), 0.2);
  }

  QuadrupedRig rig_;
};

TEST_P(QuadrupedMotionTest, LiesDampedAtTheStart) {
  rig_.Start("lying");
  EXPECT_EQ(rig_.state().id, kDamped);
  rig_.Run(1);
  EXPECT_NEAR(rig_.height(), rig_.spec().lying.height, 0.02);
  for (const robot::MotorCommand& motor : rig_.command().motors) {
    EXPECT_EQ(motor.kp, 0);
    EXPECT_EQ(motor.kd, figures().damping_kd);
  }
}

TEST_P(QuadrupedMotionTest, HoldsAStandItStartsIn) {
  rig_.Start("standing");
  EXPECT_EQ(rig_.state().id, kStanding);
  EXPECT_EQ(rig_.state().mode, 9);
  double low = rig_.height();
  for (int i = 0; i < 30; ++i) {
    rig_.Run(0.1);
    low = std::min(low, rig_.height());
  }
  EXPECT_GT(low, stand() - 0.03);
  ExpectStandsLevel();
}

TEST_P(QuadrupedMotionTest, StandsUpWithLockedJoints) {
  rig_.Start("lying");
  rig_.Run(0.5);
  EXPECT_EQ(rig_.Ask(goal::StandUp{}), authority::MotionVerdict::kTaken);
  rig_.Run(4);
  EXPECT_EQ(rig_.state().id, kLocked);
  EXPECT_EQ(rig_.state().mode, 6);
  ExpectStandsLevel();
  const robot::RobotCommand before = rig_.command();
  rig_.Run(0.5);
  EXPECT_EQ(rig_.command().motors, before.motors);
  EXPECT_LT(rig_.longest_saturation(), 0.05);
}

TEST_P(QuadrupedMotionTest, LiesDownAgain) {
  rig_.StandUp();
  EXPECT_EQ(rig_.Ask(goal::StandDown{}), authority::MotionVerdict::kTaken);
  rig_.Run(4);
  EXPECT_EQ(rig_.state().id, kCrouch);
  EXPECT_EQ(rig_.state().mode, 5);
  EXPECT_NEAR(rig_.height(), rig_.spec().lying.height, 0.02);
  EXPECT_LT(rig_.tilt(), 5 * kDegree);
  EXPECT_EQ(rig_.Ask(goal::StandUp{}), authority::MotionVerdict::kTaken);
  rig_.Run(4);
  EXPECT_EQ(rig_.state().id, kLocked);
  ExpectStandsLevel();
}

TEST_P(QuadrupedMotionTest, IsDampedAWhileAfterItHasLainDown) {
  rig_.StandUp();
  rig_.Ask(goal::StandDown{});
  ASSERT_TRUE(rig_.RunUntil(kCrouch, 1));
  EXPECT_TRUE(rig_.RunUntil(kDamped, 9));
  EXPECT_EQ(rig_.state().mode, 7);
}

TEST_P(QuadrupedMotionTest, RisesInTheModeThatWasSeenOnAB2) {
  rig_.Start("lying");
  rig_.Ask(goal::StandUp{});
  rig_.Run(0.1);
  EXPECT_EQ(rig_.state().id, kLocked);
  EXPECT_EQ(rig_.state().mode, 3);
}

TEST_P(QuadrupedMotionTest, ShiftsItsBodyOverItsFeet) {
  rig_.BalanceStand();
  const Vector3d before = rig_.world().robot().base().p_WB;
  EXPECT_EQ(rig_.Ask(goal::BodyPosition{0.05, 0.03, -0.03, 0.1}), authority::MotionVerdict::kTaken);
  rig_.Run(2);
  const Vector3d way = rig_.world().robot().base().p_WB - before;
  const bool rolls = test::ShippedRobot(GetParam()).kind == robot::RobotKind::kWheeled;
  EXPECT_NEAR(way.x(), 0.05, rolls ? 0.04 : 0.015);
  EXPECT_NEAR(way.y(), 0.03, rolls ? 0.02 : 0.015);
  EXPECT_NEAR(way.z(), -0.03, 0.005);
  EXPECT_NEAR(rig_.rpy()[2], 0.1, 0.05);
}

TEST_P(QuadrupedMotionTest, CountsItsPlaceAnewWhenToldTo) {
  rig_.BalanceStand();
  rig_.Ask(goal::Euler{0, 0.2, 0});
  rig_.Run(1);
  ASSERT_GT(rig_.state().p_WB.norm(), 1e-3);
  EXPECT_EQ(rig_.Ask(goal::ResetEstimator{}), authority::MotionVerdict::kTaken);
  EXPECT_LT(rig_.state().p_WB.norm(), 1e-9);
}

TEST_P(QuadrupedMotionTest, BalancesAtItsHeight) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.state().id, kBalance);
  EXPECT_EQ(rig_.state().mode, 9);
  ExpectStandsLevel(kDegree);
  EXPECT_NEAR(rig_.height(), stand(), 0.005);
  EXPECT_NEAR(rig_.state().body_height, stand(), 0.005);
}

TEST_P(QuadrupedMotionTest, TurnsTheBodyAsAsked) {
  rig_.BalanceStand();
  for (const Vector3d& rpy :
       {Vector3d(0.5, 0, 0), Vector3d(-0.5, 0, 0), Vector3d(0, 0.5, 0), Vector3d(0, -0.5, 0),
        Vector3d(0, 0, 0.4), Vector3d(0, 0, -0.4), Vector3d(0.2, -0.2, 0.2)}) {
    EXPECT_EQ(rig_.Ask(goal::Euler{rpy[0], rpy[1], rpy[2]}), authority::MotionVerdict::kTaken);
    rig_.Run(2);
    EXPECT_NEAR(rig_.rpy()[0], rpy[0], 3 * kDegree);
    EXPECT_NEAR(rig_.rpy()[1], rpy[1], 3 * kDegree);
    EXPECT_NEAR(rig_.rpy()[2], rpy[2], 6 * kDegree) << "wheels turn on their tyres";
  }
  EXPECT_LT(rig_.longest_saturation(), 0.05);
}

TEST_P(QuadrupedMotionTest, TurnsTheBodyAsFarAsTheVendorAllows) {
  rig_.BalanceStand();
  const Eigen::Vector3d& most = figures().euler_range;
  for (const double sign : {1.0, -1.0}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      authority::goal::Numbers value{};
      value[axis] = sign * 9;  // is cut
      rig_.Ask(goal::Euler::From(value));
      rig_.Run(2.5);
      // A Go2 that bows so far would touch the ground with its chin and stops before. Yaw is that
      // over the feet, which turn a little on the ground, wheels more so.
      const double tolerance = (axis == 2 ? 15 : 7) * kDegree;
      EXPECT_NEAR(rig_.rpy()[static_cast<Eigen::Index>(axis)],
                  sign * most[static_cast<Eigen::Index>(axis)], tolerance);
    }
  }
  rig_.Ask(goal::Euler{});
  rig_.Run(2);
  EXPECT_EQ(rig_.state().id, kBalance);
  ExpectStandsLevel();
}

TEST_P(QuadrupedMotionTest, ChangesItsHeight) {
  rig_.BalanceStand();
  for (const double height : figures().height_range) {
    EXPECT_EQ(rig_.Ask(goal::BodyHeight{height}), authority::MotionVerdict::kTaken);
    rig_.Run(2);
    EXPECT_NEAR(rig_.height(), stand() + height, 0.01);
    EXPECT_NEAR(rig_.state().body_height, stand() + height, 0.01);
    EXPECT_LT(rig_.tilt(), kDegree);
  }
  rig_.Ask(goal::BodyHeight{1});
  rig_.Run(1);
  EXPECT_LT(rig_.height(), stand() + figures().height_range[1] + 0.01) << "is cut to the range";
  EXPECT_EQ(rig_.Ask(goal::StopMove{}), authority::MotionVerdict::kTaken);
  rig_.Run(2);
  EXPECT_NEAR(rig_.height(), stand(), 0.01);
}

TEST_P(QuadrupedMotionTest, SitsAndRises) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.Ask(goal::Sit{}), authority::MotionVerdict::kTaken);
  rig_.Run(3);
  EXPECT_EQ(rig_.state().id, kSit);
  EXPECT_EQ(rig_.state().mode, 10);
  EXPECT_NEAR(rig_.rpy()[1], figures().sit[2], 4 * kDegree) << "nose up";
  EXPECT_LT(rig_.height(), stand() - 0.05);
  EXPECT_EQ(rig_.Ask(goal::Gesture{}), authority::MotionVerdict::kNotNow);
  EXPECT_EQ(rig_.Ask(goal::RiseSit{}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(rig_.RunUntil(kBalance, 3));
  rig_.Run(2);
  ExpectStandsLevel();
}

TEST_P(QuadrupedMotionTest, RaisesItsPawToSayHello) {
  rig_.BalanceStand();
  const int calf = rig_.world().robot().Body("FR_calf");
  EXPECT_EQ(rig_.Ask(goal::Gesture{}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(rig_.state().progress, 1);
  double highest = 0, tilt = 0;
  while (rig_.state().id == kGesture && highest < 2) {
    rig_.Run(0.05);
    highest = std::max(highest, rig_.world().Point(calf, {0, 0, -0.2}).p_WP.z());
    tilt = std::max(tilt, rig_.tilt());
  }
  EXPECT_GT(highest, 0.5 * stand());
  EXPECT_LT(tilt, 0.7);
  rig_.Run(2);
  EXPECT_EQ(rig_.state().id, kBalance);
  EXPECT_EQ(rig_.state().progress, 0);
  ExpectStandsLevel(3 * kDegree);
  EXPECT_LT(rig_.longest_saturation(), 0.05);
}

TEST_P(QuadrupedMotionTest, StretchesAndEndsStanding) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.Ask(goal::Gesture{goal::GestureName::kStretch}), authority::MotionVerdict::kTaken);
  double down = 0, up = 0;
  for (int i = 0; i < 70 && rig_.state().id == kGesture; ++i) {
    rig_.Run(0.1);
    down = std::max(down, rig_.rpy()[1]);
    up = std::min(up, rig_.rpy()[1]);
  }
  EXPECT_GT(down, 0.3);
  EXPECT_LT(up, -0.2);
  rig_.Run(1);
  EXPECT_EQ(rig_.state().id, kBalance);
  ExpectStandsLevel();
}

TEST_P(QuadrupedMotionTest, StopsAGestureAndStands) {
  rig_.BalanceStand();
  rig_.Ask(goal::Gesture{});
  rig_.Run(2.3);
  EXPECT_EQ(rig_.Ask(goal::StopMove{}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(rig_.state().id, kGesture) << "the paw comes down first";
  EXPECT_TRUE(rig_.RunUntil(kBalance, 3));
  rig_.Run(2);
  ExpectStandsLevel(3 * kDegree);
}

TEST_P(QuadrupedMotionTest, PosesAndRestores) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.Ask(goal::Pose{}), authority::MotionVerdict::kTaken);
  rig_.Run(2);
  EXPECT_EQ(rig_.state().id, kPose);
  EXPECT_GT(rig_.tilt(), 5 * kDegree);
  EXPECT_EQ(rig_.Ask(goal::EndPose{}), authority::MotionVerdict::kTaken);
  rig_.Run(2);
  EXPECT_EQ(rig_.state().id, kBalance);
  ExpectStandsLevel();
}

TEST_P(QuadrupedMotionTest, SinksDownWhenDamped) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.Ask(goal::Damp{}), authority::MotionVerdict::kTaken);
  rig_.Run(0.1);
  EXPECT_GT(rig_.height(), 0.7 * stand()) << "brakes, does not drop";
  rig_.Run(3);
  EXPECT_EQ(rig_.state().id, kDamped);
  EXPECT_LT(rig_.height(), 0.5 * stand());
  EXPECT_LT(rig_.fastest(), 0.1);
}

// 0.33 m/s: 5 N·s on a Go2 of 15 kg.
TEST_P(QuadrupedMotionTest, TakesAPushFromAnySide) {
  rig_.BalanceStand();
  const double force = 0.33 * rig_.world().robot().weight() / 9.81 / 0.1;
  for (const Vector3d& side : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0),
                               Vector3d(0, -1, 0), Vector3d(0, 0, -2)}) {
    rig_.Push(force * side, 0.1);
    rig_.Run(2);
    EXPECT_EQ(rig_.state().id, kBalance);
    ExpectStandsLevel();
  }
}

TEST_P(QuadrupedMotionTest, LeavesStrangeGoalsAlone) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.Ask(goal::Euler{NAN}), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(rig_.Ask(goal::SetFsm{1}), authority::MotionVerdict::kUnknown);
  EXPECT_EQ(rig_.state().id, kBalance);
}

TEST_P(QuadrupedMotionTest, DampsItselfWhenItFalls) {
  rig_.BalanceStand();
  rig_.Push(Vector3d(0, 3 * rig_.world().robot().weight(), 0), 0.15);
  EXPECT_TRUE(rig_.RunUntil(kDamped, 2));
  EXPECT_GT(rig_.tilt(), 1);
  EXPECT_EQ(rig_.Ask(goal::StandUp{}), authority::MotionVerdict::kNotNow);
  EXPECT_EQ(rig_.Ask(goal::StandDown{}), authority::MotionVerdict::kNotNow);
}

INSTANTIATE_TEST_SUITE_P(Robots, QuadrupedMotionTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy::motion
