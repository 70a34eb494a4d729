#include "motion/damping_motion.h"

#include <gtest/gtest.h>

namespace understudy::motion {

namespace goal = authority::goal;
namespace {

class DampingMotionTest : public ::testing::Test {
 protected:
  robot::RobotCommand Step() {
    robot::RobotCommand command{.motors = std::vector<robot::MotorCommand>(2)};
    motion_.Step({}, 0.002, &command);
    return command;
  }
  DampingMotion motion_{{.id = 1}, {.id = 0}, 3};
};

TEST_F(DampingMotionTest, DampsEveryMotor) {
  for (const robot::MotorCommand& motor : Step().motors) {
    EXPECT_EQ(motor, (robot::MotorCommand{.enabled = true, .q = robot::kNoPosition, .kd = 3}));
  }
  EXPECT_EQ(motion_.state().id, 1);
}

TEST_F(DampingMotionTest, GoesLimpAndBack) {
  EXPECT_EQ(motion_.Ask(goal::ZeroTorque{}), authority::MotionVerdict::kTaken);
  for (const robot::MotorCommand& motor : Step().motors) EXPECT_FALSE(motor.enabled);
  EXPECT_EQ(motion_.state().id, 0);
  EXPECT_EQ(motion_.Ask(goal::Damp{}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(Step().motors[0].enabled);
}

TEST_F(DampingMotionTest, KnowsItsStatesByTheirIds) {
  EXPECT_EQ(motion_.Ask(goal::SetFsm{0}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(motion_.state().id, 0);
  EXPECT_EQ(motion_.Ask(goal::SetFsm{1}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(motion_.state().id, 1);
  EXPECT_EQ(motion_.Ask(goal::SetFsm{4}), authority::MotionVerdict::kUnable);
}

TEST_F(DampingMotionTest, StaysLimpWhereItsRobotLiesOnItsSide) {
  motion_.Ask(goal::ZeroTorque{});
  EXPECT_EQ(motion_.Ask(goal::Fall{}), authority::MotionVerdict::kNotNow);
  EXPECT_FALSE(Step().motors[0].enabled);
}

TEST_F(DampingMotionTest, CanDoNothingElse) {
  EXPECT_EQ(motion_.Ask(goal::StandUp{}), authority::MotionVerdict::kUnable);
  EXPECT_TRUE(Step().motors[0].enabled);
}

}  // namespace
}  // namespace understudy::motion
