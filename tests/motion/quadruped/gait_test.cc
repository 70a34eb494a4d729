// Tests the gait clock and the path of a swinging foot.
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "motion/quadruped/gait_clock.h"
#include "motion/quadruped/swing.h"
#include "motion/quadruped/velocity_wish.h"

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

constexpr double kStep = 0.002;  // s
constexpr GaitTiming kGait{.period = 0.5, .duty = 0.6};

TEST(GaitClockTest, DiagonalPairsStepInTurn) {
  GaitClock clock;
  clock.Begin(kGait, 0);
  int all = 0, steps = 0;
  for (; steps < 1000; ++steps) {
    clock.Advance(kStep, kGait, false);
    EXPECT_EQ(clock.stands(0), clock.stands(3));
    EXPECT_EQ(clock.stands(1), clock.stands(2));
    EXPECT_TRUE(clock.stands(0) || clock.stands(1)) << "a trot does not fly";
    all += clock.stands(0) && clock.stands(1);
  }
  EXPECT_NEAR(static_cast<double>(all) / steps, 2 * kGait.duty - 1, 0.01);
}

TEST(GaitClockTest, AllFeetStandWhileItWaits) {
  GaitClock clock;
  clock.Begin(kGait, 0.1);
  for (double t = 0; t < 0.1; t += kStep) {
    clock.Advance(kStep, kGait, false);
    EXPECT_TRUE(clock.stands(0) && clock.stands(1));
  }
}

TEST(GaitClockTest, HaltsOnFourFeetOnly) {
  GaitClock clock;
  clock.Begin(kGait, 0);
  while (clock.stands(1)) clock.Advance(kStep, kGait, false);
  EXPECT_FALSE(clock.halted());
  for (int i = 0; i < 500; ++i) clock.Advance(kStep, kGait, true);
  EXPECT_TRUE(clock.halted());
  EXPECT_TRUE(clock.stands(0) && clock.stands(1));
}

TEST(GaitClockTest, ChangesNoStepThatIsUnderWay) {
  GaitClock clock;
  clock.Begin(kGait, 0);
  while (clock.stands(1)) clock.Advance(kStep, kGait, false);
  const double left = clock.swing_left(1);
  double took = 0;
  for (; !clock.stands(1); took += kStep) {
    clock.Advance(kStep, {.period = 0.3, .duty = 0.5}, false);
  }
  EXPECT_NEAR(took, left, 2 * kStep);
  EXPECT_NEAR(clock.stance_time(), 0.15, 1e-9) << "then it does";
}

TEST(GaitClockTest, ThePairThatLiftsFirstIsTheOneThatHasStoodLongest) {
  for (const auto& [phase, first] : {std::pair(0.0, 1), std::pair(0.5, 0)}) {
    GaitClock clock;
    clock.Begin(kGait, 0, phase);
    while (clock.stands(0) && clock.stands(1)) clock.Advance(kStep, kGait, false);
    EXPECT_FALSE(clock.stands(static_cast<std::size_t>(first)));
  }
}

// One foot after the other.
constexpr GaitTiming kWalk{.period = 1, .duty = 0.8, .offsets = {0.75, 0.25, 0.5, 0}};

int Standing(const GaitClock& clock) {
  int feet = 0;
  for (std::size_t leg = 0; leg < 4; ++leg) feet += clock.stands(leg);
  return feet;
}

TEST(GaitClockTest, FeetStepWhenTheirOffsetsSay) {
  GaitClock clock;
  clock.Begin(kWalk, 0);
  std::vector<std::size_t> lifted;
  std::array<bool, 4> stood{true, true, true, true};
  for (int i = 0; i < 490; ++i) {
    clock.Advance(kStep, kWalk, false);
    EXPECT_GE(Standing(clock), 3);
    for (std::size_t leg = 0; leg < 4; ++leg) {
      if (stood[leg] && !clock.stands(leg)) lifted.push_back(leg);
      stood[leg] = clock.stands(leg);
    }
  }
  EXPECT_EQ(lifted, (std::vector<std::size_t>{0, 2, 1, 3}));
}

TEST(GaitClockTest, TakesOtherOffsetsOverOnceAllFeetStand) {
  GaitClock clock;
  clock.Begin(kGait, 0);
  while (clock.stands(1)) clock.Advance(kStep, kGait, false);
  for (int i = 0; !clock.stands(1); ++i) {
    ASSERT_LT(i, 500);
    clock.Advance(kStep, kWalk, false);
    EXPECT_EQ(clock.stands(1), clock.stands(2)) << "the step under way ends as it began";
  }
  bool walks = false;
  for (int i = 0; i < 500; ++i) {
    clock.Advance(kStep, kWalk, false);
    walks = walks || Standing(clock) == 3;
    EXPECT_GE(Standing(clock), 3);
  }
  EXPECT_TRUE(walks);
}

TEST(SwingTest, LeavesAndArrivesAtRest) {
  const Vector3d from(0.1, 0.2, 0), to(0.3, 0.15, 0.05);
  for (const auto& [s, place] : {std::pair(0.0, from), std::pair(1.0, to)}) {
    const FootMotion motion = SwingFoot(from, to, 0.08, 0.2, s);
    EXPECT_LT((motion.p - place).norm(), 1e-9);
    EXPECT_LT(motion.v.norm(), 1e-9);
  }
  EXPECT_NEAR(SwingFoot(from, to, 0.08, 0.2, 0.5).p.z(), 0.025 + 0.08, 1e-9);
}

TEST(SwingTest, RatesAreThoseOfTheWay) {
  const Vector3d from(0.1, 0.2, 0), to(0.3, 0.15, 0.05);
  constexpr double kTime = 0.2, kSmall = 1e-5;
  const auto at = [&](double s) { return SwingFoot(from, to, 0.08, kTime, s); };
  for (double s = 0.05; s < 1; s += 0.1) {
    const Vector3d v = (at(s + kSmall).p - at(s - kSmall).p) / (2 * kSmall * kTime);
    const Vector3d a = (at(s + kSmall).v - at(s - kSmall).v) / (2 * kSmall * kTime);
    EXPECT_LT((at(s).v - v).norm(), 1e-4);
    EXPECT_LT((at(s).a - a).norm(), 1e-3);
  }
}

class VelocityWishTest : public testing::Test {
 protected:
  VelocityWishTest() {
    spec.dead_band = {0.05, 0.1, 0.2};
    spec.gain = {0.9, 1, 1};
    spec.time_constant = {0.4, 0.4, 0.4};
    spec.dead_time = 0.06;
    wish.Begin();
  }
  Vector3d After(double seconds) {
    for (double t = 0; t < seconds - kStep / 2; t += kStep) wish.Step(kStep);
    return wish.velocity();
  }
  robot::WalkSpec spec;
  VelocityWish wish{spec};
};

TEST_F(VelocityWishTest, BeginsAfterTheDeadTimeAndLagsByTheTimeConstant) {
  wish.Ask({0.5, 0, 0});
  EXPECT_EQ(After(0.06).x(), 0);
  EXPECT_NEAR(After(0.4).x(), 0.45 * (1 - std::exp(-1)), 0.003);
  EXPECT_NEAR(After(4).x(), 0.45, 1e-3);
  EXPECT_FALSE(wish.at_rest());
}

TEST_F(VelocityWishTest, WhatMovesWhenItBeginsComesToRestFromThere) {
  wish.Begin({1, 0, 0});
  EXPECT_FALSE(wish.at_rest());
  EXPECT_NEAR(After(0.4).x(), std::exp(-1), 0.003);
  EXPECT_NEAR(After(4).x(), 0, 1e-3);
}

TEST_F(VelocityWishTest, ComesToRestSoonerInAHurry) {
  wish.Begin({1, 0, 0});
  wish.Hurry(true);
  EXPECT_NEAR(After(0.4).x(), std::exp(-1 / 0.4), 0.003);
  wish.Hurry(false);
  EXPECT_NEAR(After(0.4).x(), std::exp(-1 / 0.4 - 1), 0.003);
}

TEST_F(VelocityWishTest, DoesNotOvershootInStepsLongerThanItsTimeConstant) {
  wish.Ask({0.5, 0, 0});
  for (int i = 0; i < 5; ++i) {
    wish.Step(1);
    EXPECT_LE(wish.velocity().x(), 0.45);
  }
  EXPECT_NEAR(wish.velocity().x(), 0.45, 1e-9);
}

TEST_F(VelocityWishTest, CutsToWhatTheGaitCan) {
  EXPECT_EQ(wish.Taken({9, -9, 9}), Vector3d(1, -0.4, 1));
}

TEST_F(VelocityWishTest, TakesASharpBendAsSharpButSlower) {
  spec.most_speed = {2, 0.8, 3};
  const Vector3d asked(2, 0, 3), taken = wish.Taken(asked);
  EXPECT_NEAR(taken.x() * taken.z(), 2, 1e-9) << "m/s² aside";
  EXPECT_TRUE(taken.normalized().isApprox(asked.normalized()));
  EXPECT_EQ(wish.Taken({1, 0, 1.9}), Vector3d(1, 0, 1.9));
  EXPECT_EQ(wish.Taken({0, 0, 3}), Vector3d(0, 0, 3));
}

TEST_F(VelocityWishTest, ACommandIsNoneOnlyWhenAllOfItIsWithinTheDeadBand) {
  EXPECT_TRUE(wish.Taken({0.05, -0.1, 0.2}).isZero(0));
  EXPECT_EQ(wish.Taken({0.3, 0.01, 0.01}), Vector3d(0.3, 0.01, 0.01));
}

}  // namespace
}  // namespace understudy::motion
