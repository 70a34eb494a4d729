#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "robot/motor.h"

namespace understudy::robot {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(AsksForTorqueTest, OnlyWhatIsMoreThanABrake) {
  EXPECT_FALSE(AsksForTorque({.enabled = true, .kd = 3}));
  EXPECT_FALSE(AsksForTorque({.enabled = true, .q = kNoPosition, .kp = 20}));
  EXPECT_FALSE(AsksForTorque({.enabled = true, .dq = kNoVelocity, .kd = 3}));
  EXPECT_FALSE(AsksForTorque({.enabled = true, .dq = 1})) << "without a gain";
  EXPECT_FALSE(AsksForTorque({.enabled = false, .tau = 3}));
  EXPECT_TRUE(AsksForTorque({.enabled = true, .kp = 20}));
  EXPECT_TRUE(AsksForTorque({.enabled = true, .tau = -0.1}));
  EXPECT_TRUE(AsksForTorque({.enabled = true, .dq = 1, .kd = 3}));
}

TEST(DesiredTorqueTest, IsFeedForwardPlusSpringPlusDamper) {
  const MotorCommand command{.enabled = true, .q = 3, .dq = 5, .tau = 1, .kp = 10, .kd = 2};
  // 1 + 10 (3 - 2) + 2 (5 - 4)
  EXPECT_EQ(DesiredTorque(command, 2, 4), 13);
}

TEST(DesiredTorqueTest, PullsTowardsThePositionFromBothSides) {
  const MotorCommand command{.enabled = true, .kp = 10};
  EXPECT_EQ(DesiredTorque(command, 1, 0), -10);
  EXPECT_EQ(DesiredTorque(command, -1, 0), 10);
}

TEST(DesiredTorqueTest, DampsAgainstTheMotion) {
  const MotorCommand command{.enabled = true, .kd = 2};
  EXPECT_EQ(DesiredTorque(command, 0, 3), -6);
  EXPECT_EQ(DesiredTorque(command, 0, -3), 6);
}

TEST(DesiredTorqueTest, LeavesOutTheSpringWithoutAPosition) {
  const MotorCommand command{
      .enabled = true, .q = kNoPosition, .dq = 1, .tau = 3, .kp = 100, .kd = 2};
  EXPECT_EQ(DesiredTorque(command, 0.5, 0), 5);
}

TEST(DesiredTorqueTest, LeavesOutTheDamperWithoutAVelocity) {
  const MotorCommand command{
      .enabled = true, .q = 1, .dq = kNoVelocity, .tau = 3, .kp = 100, .kd = 2};
  EXPECT_EQ(DesiredTorque(command, 0, 7), 103);
}

// The wire carries single precision: a mark that changed on its way through would be a target of
// two thousand million radians.
TEST(DesiredTorqueTest, KnowsTheMarksAfterSinglePrecision) {
  EXPECT_EQ(static_cast<double>(static_cast<float>(kNoPosition)), kNoPosition);
  EXPECT_EQ(static_cast<double>(static_cast<float>(kNoVelocity)), kNoVelocity);
}

TEST(DesiredTorqueTest, IsZeroForADisabledMotorWhateverElseItIsTold) {
  const MotorCommand command{.enabled = false, .q = 3, .dq = 5, .tau = 1, .kp = 10, .kd = 2};
  EXPECT_EQ(DesiredTorque(command, 2, 4), 0);
}

TEST(DesiredTorqueTest, IsZeroForADisabledMotorThatIsToldNan) {
  EXPECT_EQ(DesiredTorque({.enabled = false, .q = kNan, .tau = kNan}, 0, 0), 0);
}

TEST(DesiredTorqueTest, PassesNanThrough) {
  EXPECT_TRUE(std::isnan(DesiredTorque({.enabled = true, .q = kNan, .kp = 1}, 0, 0)));
  EXPECT_TRUE(std::isnan(DesiredTorque({.enabled = true, .tau = kNan}, 0, 0)));
  EXPECT_TRUE(std::isnan(DesiredTorque({.enabled = true, .kp = 1}, kNan, 0)));
}

// 20 N·m up to 10 rad/s, nothing from 30 rad/s.
constexpr TorqueCurve kMotor{.limit = 20, .knee = 10, .no_load = 30};

TEST(AvailableTorqueTest, LeavesASmallTorqueAlone) {
  EXPECT_EQ(AvailableTorque(kMotor, 7, 0), 7);
  EXPECT_EQ(AvailableTorque(kMotor, -7, 29), -7);
}

struct Row {
  double dq;        // rad/s
  double wanted;    // N·m
  double expected;  // N·m
};

TEST(AvailableTorqueTest, FollowsTheTorqueSpeedCurve) {
  const Row rows[] = {
      {0, 100, 20},                       // standstill: the limit
      {0, -100, -20},                     // and the other way
      {10, 100, 20},                      // driving at the knee: still all of it
      {15, 100, 15},                      // a quarter of the way down
      {20, 100, 10},                      // half way
      {-20, -100, -10}, {30, 100, 0},     // no-load speed: nothing left to drive with
      {50, 100, 0},                       // beyond it
      {-50, -100, 0},   {20, -100, -20},  // braking: the limit at any speed
      {-20, 100, 20},   {50, -100, -20}, {20, 0, 0},
  };
  for (const Row& row : rows) {
    EXPECT_EQ(AvailableTorque(kMotor, row.wanted, row.dq), row.expected)
        << row.wanted << " N·m at " << row.dq << " rad/s";
  }
}

TEST(AvailableTorqueTest, KnowsTheLimitAloneWithoutAKnee) {
  EXPECT_EQ(AvailableTorque({.limit = 20}, 100, 1000), 20);
}

TEST(AvailableTorqueTest, DropsAtOnceWhereKneeAndNoLoadSpeedAreOne) {
  const TorqueCurve motor{.limit = 20, .knee = 10, .no_load = 10};
  EXPECT_EQ(AvailableTorque(motor, 100, 10), 20);
  EXPECT_EQ(AvailableTorque(motor, 100, 11), 0);
}

// At half of its voltage it ends at 15 rad/s, and the line passes 20 N·m at -5.
TEST(AvailableTorqueTest, LosesSpeedAndThenTorqueWithItsVoltage) {
  EXPECT_EQ(AvailableTorque(kMotor, 100, 0, 0.5), 15);
  EXPECT_EQ(AvailableTorque(kMotor, 100, 5, 0.5), 10);
  EXPECT_EQ(AvailableTorque(kMotor, -100, -5, 0.5), -10);
  EXPECT_EQ(AvailableTorque(kMotor, 100, 15, 0.5), 0);
  EXPECT_EQ(AvailableTorque(kMotor, 100, -5, 0.5), 20);  // braking
  EXPECT_EQ(AvailableTorque(kMotor, 100, 0, 2.0 / 3), 20);
  EXPECT_EQ(AvailableTorque(kMotor, 100, 0, 0), 0);
}

TEST(AvailableTorqueTest, GoesDownWithItsVoltageAtEverySpeedWithoutAKnee) {
  EXPECT_EQ(AvailableTorque({.limit = 20}, 100, 1000, 0.5), 10);
}

TEST(AvailableTorqueTest, IsCutByHeatAtItsLimitAndNotBelow) {
  EXPECT_EQ(AvailableTorque(kMotor, 100, 0, 1, 0.5), 10);
  EXPECT_EQ(AvailableTorque(kMotor, 7, 0, 1, 0.5), 7);
  EXPECT_EQ(AvailableTorque(kMotor, 100, 25, 1, 0.5), 5);  // where its voltage leaves less
}

TEST(AvailableTorqueTest, PassesNanThrough) {
  EXPECT_TRUE(std::isnan(AvailableTorque(kMotor, kNan, 0)));
}

}  // namespace
}  // namespace understudy::robot
