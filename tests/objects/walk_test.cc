#include "objects/walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace understudy::objects {
namespace {

constexpr double kPi = std::numbers::pi;

// A person of 1 m/s who walks 4 m along +x from (1, 2), and 3 m along +y.
ObjectSpec Corner() {
  return {.kind = "person",
          .pos = {1, 2, 0},
          .path = {{.to = {5, 2}}, {.to = {5, 5}, .wait = 2}},
          .speed = 1,
          .wait = 3};
}

void ExpectAt(const Walk& walk, double t, double x, double y, double yaw) {
  const WalkPose at = walk.At(t);
  EXPECT_NEAR(at.x, x, 1e-9) << t;
  EXPECT_NEAR(at.y, y, 1e-9) << t;
  EXPECT_NEAR(std::remainder(at.yaw - yaw, 2 * kPi), 0, 1e-9) << t;
}

TEST(WalkTest, WaitsThenWalksFromCornerToCornerAtItsSpeed) {
  const Walk walk(Corner());
  const double turn = kPi / 2 / Walk::kTurnRate;
  ExpectAt(walk, 0, 1, 2, 0);
  ExpectAt(walk, 2.9, 1, 2, 0);
  ExpectAt(walk, 4, 2, 2, 0);
  EXPECT_EQ(walk.At(4).vx, 1);
  ExpectAt(walk, 7 + turn / 2, 5, 2, kPi / 4);
  EXPECT_EQ(walk.At(7 + turn / 2).turn, Walk::kTurnRate);
  ExpectAt(walk, 8 + turn, 5, 3, kPi / 2);
  EXPECT_EQ(walk.At(8 + turn).vy, 1);
}

TEST(WalkTest, HasTheSpeedOfItsKindUnlessItHasItsOwn) {
  ObjectSpec person = Corner();
  person.speed = 0;
  EXPECT_EQ(Walk(person).At(4).vx, 1.4);
}

TEST(WalkTest, GoesBackTheWayItCame) {
  const Walk walk(Corner());
  const double quarter = kPi / 2 / Walk::kTurnRate;
  const double there = 3 + 4 + quarter + 3;
  ExpectAt(walk, there + 2 * quarter + 1, 5, 5, -kPi / 2);  // it has turned round, and waits
  ExpectAt(walk, there + 2 * quarter + 3, 5, 4, -kPi / 2);
  const double again = there + 2 * quarter + 2 + 3 + quarter + 4 + 2 * quarter;
  EXPECT_NEAR(walk.period(), again, 1e-9);
  ExpectAt(walk, again + 4, 2, 2, 0);
  ExpectAt(walk, 100 * again + 4, 2, 2, 0);
}

TEST(WalkTest, GoesRound) {
  ObjectSpec object = Corner();
  object.then = PathEnd::kRound;
  const Walk walk(object);
  const double before = walk.period() - (kPi - std::atan2(3, 4)) / Walk::kTurnRate;
  ExpectAt(walk, before - 2.5, 3, 3.5, std::atan2(-3, -4));
  ExpectAt(walk, walk.period() + 4, 2, 2, 0);
}

TEST(WalkTest, StaysAtItsEnd) {
  ObjectSpec object = Corner();
  object.then = PathEnd::kStay;
  const Walk walk(object);
  ExpectAt(walk, walk.period() - 1, 5, 4, kPi / 2);
  ExpectAt(walk, walk.period(), 5, 5, kPi / 2);
  ExpectAt(walk, 1e6, 5, 5, kPi / 2);
  EXPECT_EQ(walk.At(1e6).vy, 0);
}

// What sensors and contacts meet are surfaces with the velocity that it says.
TEST(WalkTest, NeverJumpsAndMovesAsItsVelocitySays) {
  for (const PathEnd then : {PathEnd::kBack, PathEnd::kRound, PathEnd::kStay}) {
    ObjectSpec object = Corner();
    object.then = then;
    const Walk walk(object);
    constexpr double kStep = 1e-3;
    for (double t = 0; t < 2 * walk.period(); t += kStep) {
      const WalkPose at = walk.At(t), next = walk.At(t + kStep);
      ASSERT_LT(std::hypot(next.x - at.x, next.y - at.y), 1.01 * kStep) << t;
      ASSERT_LT(std::abs(std::remainder(next.yaw - at.yaw, 2 * kPi)),
                1.01 * Walk::kTurnRate * kStep)
          << t;
      if (next.vx != at.vx || next.vy != at.vy || next.turn != at.turn) continue;
      ASSERT_NEAR(next.x - at.x, at.vx * kStep, 1e-9) << t;
      ASSERT_NEAR(next.y - at.y, at.vy * kStep, 1e-9) << t;
      ASSERT_NEAR(next.swing - at.swing, (at.swing_rate + next.swing_rate) / 2 * kStep, 1e-5) << t;
      ASSERT_NEAR(std::remainder(next.yaw - at.yaw, 2 * kPi), at.turn * kStep, 1e-9) << t;
    }
  }
}

TEST(WalkTest, SwingsLegsByHalfAStepEachWayWhileItWalks) {
  ObjectSpec object = Corner();
  const Walk walk(object);
  EXPECT_EQ(walk.At(2).swing, 0) << "it stands";
  EXPECT_EQ(walk.At(7.3).swing, 0) << "it turns";
  double most = 0, least = 0;
  for (double t = 3; t < 7; t += 0.01) {
    most = std::max(most, walk.At(t).swing);
    least = std::min(least, walk.At(t).swing);
  }
  EXPECT_NEAR(most, std::atan(0.35 / 0.82), 1e-3);
  EXPECT_NEAR(least, -most, 1e-3);
  EXPECT_NEAR(walk.At(6.9999).swing, 0, 1e-3) << "the legs come together";
  object.kind = "cart";
  EXPECT_EQ(Walk(object).At(5).swing, 0);
}

TEST(WalkTest, BeginsWhereItsSeedDraws) {
  ObjectSpec object = Corner();
  const Walk plain(object);
  object.seed = 7;
  const Walk drawn(object), same(object);
  object.seed = 8;
  const Walk other_seed(object);
  EXPECT_GT(std::hypot(other_seed.At(0).x - drawn.At(0).x, other_seed.At(0).y - drawn.At(0).y),
            0.1);
  EXPECT_EQ(same.At(2).x, drawn.At(2).x);
  EXPECT_EQ(drawn.period(), plain.period());
  // It is on the same way, so many seconds later.
  double begins = 0;
  const auto is_it = [&] {
    const WalkPose one = plain.At(begins), other = drawn.At(0);
    return std::hypot(one.x - other.x, one.y - other.y) < 2e-3 &&
           std::abs(one.yaw - other.yaw) < 5e-3;
  };
  while (begins < plain.period() && !is_it()) begins += 1e-3;
  EXPECT_GT(begins, 0.1);
  EXPECT_LT(begins, plain.period());
}

}  // namespace
}  // namespace understudy::objects
