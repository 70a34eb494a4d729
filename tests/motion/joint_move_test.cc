#include "motion/joint_move.h"

#include <array>

#include <gtest/gtest.h>

namespace understudy::motion {
namespace {

TEST(SmoothStepTest, StaysWithinItsEnds) {
  EXPECT_EQ(SmoothStep(-1), 0);
  EXPECT_EQ(SmoothStep(0.5), 0.5);
  EXPECT_EQ(SmoothStep(2), 1);
}

TEST(SmoothStepTest, HasTheRateOfItsSlope) {
  constexpr double kStep = 1e-6;
  for (const double s : {0.1, 0.35, 0.5, 0.9}) {
    EXPECT_NEAR(SmoothStepRate(s), (SmoothStep(s + kStep) - SmoothStep(s - kStep)) / (2 * kStep),
                1e-6);
  }
}

TEST(JointMoveTest, IsOverBeforeItBegins) { EXPECT_TRUE(JointMove(2).over()); }

TEST(JointMoveTest, LeavesAndArrivesAtRest) {
  JointMove move(2);
  move.Begin(std::array{1.0, -1.0}, std::array{3.0, -1.0}, 4);
  EXPECT_EQ(move.q(0), 1);
  EXPECT_EQ(move.dq(0), 0);
  move.Advance(2);
  EXPECT_EQ(move.q(0), 2);
  EXPECT_EQ(move.dq(0), 30.0 / 16 * 2 / 4);
  EXPECT_EQ(move.q(1), -1);
  EXPECT_FALSE(move.over());
  move.Advance(2);
  EXPECT_TRUE(move.over());
  EXPECT_EQ(move.q(0), 3);
  EXPECT_EQ(move.dq(0), 0);
}

TEST(JointMoveTest, OfNoDurationIsThereAtOnce) {
  JointMove move(1);
  move.Begin(std::array{1.0}, std::array{2.0}, 0);
  EXPECT_TRUE(move.over());
  EXPECT_EQ(move.q(0), 2);
}

}  // namespace
}  // namespace understudy::motion
