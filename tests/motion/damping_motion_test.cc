#include "motion/damping_motion.h"

#include <gtest/gtest.h>

namespace understudy {
namespace {

class DampingMotionTest : public ::testing::Test {
 protected:
  RobotCommand Step() {
    RobotCommand command{.motors = std::vector<MotorCommand>(2)};
    motion_.Step({}, 0.002, &command);
    return command;
  }
  DampingMotion motion_{{.id = 1}, {.id = 0}, 3};
};

TEST_F(DampingMotionTest, DampsEveryMotor) {
  for (const MotorCommand& motor : Step().motors) {
    EXPECT_EQ(motor, (MotorCommand{.enabled = true, .q = kNoPosition, .kd = 3}));
  }
  EXPECT_EQ(motion_.state().id, 1);
}

TEST_F(DampingMotionTest, GoesLimpAndBack) {
  EXPECT_EQ(motion_.Ask({.action = MotionAction::kZeroTorque}), MotionVerdict::kTaken);
  for (const MotorCommand& motor : Step().motors) EXPECT_FALSE(motor.enabled);
  EXPECT_EQ(motion_.state().id, 0);
  EXPECT_EQ(motion_.Ask({.action = MotionAction::kDamp}), MotionVerdict::kTaken);
  EXPECT_TRUE(Step().motors[0].enabled);
}

TEST_F(DampingMotionTest, KnowsItsStatesByTheirIds) {
  EXPECT_EQ(motion_.Ask({.action = MotionAction::kSetFsm, .value = {0}}), MotionVerdict::kTaken);
  EXPECT_EQ(motion_.state().id, 0);
  EXPECT_EQ(motion_.Ask({.action = MotionAction::kSetFsm, .value = {1}}), MotionVerdict::kTaken);
  EXPECT_EQ(motion_.state().id, 1);
  EXPECT_EQ(motion_.Ask({.action = MotionAction::kSetFsm, .value = {4}}), MotionVerdict::kUnable);
}

TEST_F(DampingMotionTest, CanDoNothingElse) {
  EXPECT_EQ(motion_.Ask({.action = MotionAction::kStandUp}), MotionVerdict::kUnable);
  EXPECT_TRUE(Step().motors[0].enabled);
}

}  // namespace
}  // namespace understudy
