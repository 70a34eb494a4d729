#include "authority/arm_overlay.h"

#include <limits>

#include <gtest/gtest.h>

#include "robot/motor.h"

namespace understudy::authority {
namespace {

constexpr robot::MotorCommand kHold{
    .enabled = true, .q = 1, .dq = 0.5, .tau = 3, .kp = 40, .kd = 2};
constexpr robot::MotorCommand kOther{
    .enabled = true, .q = -1, .dq = 0, .tau = 1, .kp = 10, .kd = 1};
constexpr robot::MotorCommand kDamp{.enabled = true, .q = robot::kNoPosition, .kd = 4};

TEST(MixTest, GivesTheWeightedTorqueAtEveryAngleAndRate) {
  for (const robot::MotorCommand& over : {kOther, kDamp, robot::MotorCommand{}}) {
    for (const double weight : {0.0, 0.25, 0.7, 1.0}) {
      const robot::MotorCommand mixed = Mix(kHold, over, weight);
      for (const double q : {-2.0, 0.0, 1.5}) {
        for (const double dq : {-3.0, 0.0, 2.0}) {
          EXPECT_NEAR(robot::DesiredTorque(mixed, q, dq),
                      (1 - weight) * robot::DesiredTorque(kHold, q, dq) +
                          weight * robot::DesiredTorque(over, q, dq),
                      1e-9);
        }
      }
    }
  }
}

class ArmOverlayTest : public ::testing::Test {
 protected:
  ArmOverlayTest() {
    for (const int slot : {2, 5, 7}) spec_.motors.push_back({.joint = "", .slot = slot});
    spec_.arm_sdk.slots = {5, 7};
  }
  robot::RobotCommand Of(const robot::MotorCommand& motor, double weight = 0) const {
    return {.motors = {3, motor}, .weight = weight};
  }

  robot::RobotSpec spec_;
};

TEST_F(ArmOverlayTest, ChangesNothingBeforeTheFirstCommand) {
  const ArmOverlay arms(spec_);
  robot::RobotCommand command = Of(kHold);
  arms.MixOver(0, &command);
  EXPECT_EQ(command.motors, Of(kHold).motors);
}

TEST_F(ArmOverlayTest, MovesItsOwnMotorsOnly) {
  ArmOverlay arms(spec_);
  arms.Offer(Of(kOther, 1), 0);
  robot::RobotCommand command = Of(kHold);
  arms.MixOver(0, &command);
  EXPECT_EQ(command.motors[0], kHold);
  EXPECT_EQ(command.motors[1], kOther);
  EXPECT_EQ(command.motors[2], kOther);
}

TEST_F(ArmOverlayTest, CutsTheWeight) {
  ArmOverlay arms(spec_);
  arms.Offer(Of(kOther, 7), 0);
  EXPECT_EQ(arms.weight(0), 1);
  arms.Offer(Of(kOther, -1), 0);
  EXPECT_EQ(arms.weight(0), 0);
}

TEST_F(ArmOverlayTest, LeavesOutWhatWouldHarm) {
  ArmOverlay arms(spec_);
  arms.Offer(Of(kOther, 0.5), 0);
  robot::MotorCommand bad = kOther;
  bad.kp = -1;
  arms.Offer(Of(bad, 1), 0);
  arms.Offer(Of(kOther, std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(arms.weight(0), 0.5);
}

TEST_F(ArmOverlayTest, KeepsTheLastCommandUnlessItsRobotDropsIt) {
  ArmOverlay forever(spec_);
  forever.Offer(Of(kOther, 1), 0);
  EXPECT_EQ(forever.weight(1000), 1);
  spec_.arm_sdk.timeout = 0.5;
  ArmOverlay fading(spec_);
  fading.Offer(Of(kOther, 1), 0);
  EXPECT_EQ(fading.weight(0.5), 1);
  EXPECT_EQ(fading.weight(0.51), 0);
}

}  // namespace
}  // namespace understudy::authority
