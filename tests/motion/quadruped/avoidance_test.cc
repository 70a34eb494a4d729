#include "motion/quadruped/avoidance.h"

#include <cmath>
#include <initializer_list>

#include <gtest/gtest.h>

namespace understudy::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using robot::SeenObstacles;

constexpr double kDt = 0.002;
constexpr double kNose = 0.36;  // m ahead of the base's origin

SeenObstacles Seen(std::initializer_list<Vector2d> points) {
  SeenObstacles seen{.known = true};
  for (const Vector2d& point : points) seen.points[seen.count++] = point;
  return seen;
}

// Points every 6 cm from the right to the left.
SeenObstacles Wall(double x, double right, double left) {
  SeenObstacles seen{.known = true};
  for (double y = right; y <= left; y += 0.06) seen.points[seen.count++] = {x, y};
  return seen;
}

class AvoidanceTest : public testing::Test {
 protected:
  Vector3d Limit(const Vector3d& wish, const SeenObstacles& seen) {
    return avoidance_.Limit(wish, seen, kDt);
  }

  Avoidance avoidance_{true};
};

TEST_F(AvoidanceTest, LeavesAWishAsItIsWhereNothingIsInTheWay) {
  const Vector3d wish(1, 0.2, 0.3);
  EXPECT_EQ(Limit(wish, Seen({})), wish);
  EXPECT_EQ(Limit(wish, Wall(-0.8, -1, 1)), wish) << "behind it";
  EXPECT_EQ(Limit({1, 0, 0}, Seen({{1, 0.4}, {0.6, -0.4}})), Vector3d(1, 0, 0)) << "beside it";
  EXPECT_EQ(Limit({0.3, 0, 0}, Wall(kNose + 0.8, -0.1, 0.1)), Vector3d(0.3, 0, 0)) << "far enough";
}

TEST_F(AvoidanceTest, SlowsDownBeforeAWallAndStops) {
  double last = 2;
  for (double free = 2; free >= 0.4; free -= 0.1) {
    const Vector3d v = Limit({1.5, 0, 0.2}, Wall(kNose + free, -2, 2));
    EXPECT_LE(v.x(), last) << free;
    EXPECT_EQ(v.y(), 0) << "there is no way round";
    EXPECT_EQ(v.z(), 0.2) << "it may turn";
    last = v.x();
  }
  EXPECT_LT(last, 0.15);
  for (const double free : {0.4, 0.2, 0.0, -0.1}) {
    EXPECT_NEAR(Limit({1.5, 0, 0}, Wall(kNose + free, -2, 2)).x(), 0, 1e-9) << free;
  }
}

TEST_F(AvoidanceTest, StopsBeforeWhatIsBesideAndBehindItTooWhenItGoesThere) {
  SeenObstacles left{.known = true};
  for (double x = -2; x <= 2; x += 0.06) left.points[left.count++] = {x, 0.5};
  EXPECT_NEAR(Limit({0, 0.5, 0}, left).y(), 0, 1e-9);
  EXPECT_NEAR(Limit({-0.5, 0, 0}, Wall(-0.6, -2, 2)).x(), 0, 1e-9);
  EXPECT_NEAR(Limit({-0.5, 0, 0}, Wall(0.6, -2, 2)).x(), -0.5, 1e-9) << "it goes away";
}

TEST_F(AvoidanceTest, MayGoAlongAWallThatItNearlyTouches) {
  SeenObstacles seen{.known = true};
  for (double x = -0.3; x < 0.3; x += 0.05) seen.points[seen.count++] = {x, 0.2};
  EXPECT_EQ(Limit({0.5, 0, 0}, seen), Vector3d(0.5, 0, 0));
}

TEST_F(AvoidanceTest, GoesRoundWhatItSeesTheEndOf) {
  const Vector3d left = Limit({0.8, 0, 0}, Wall(kNose + 0.8, -0.6, 0.1));
  EXPECT_GT(left.y(), 0.05);
  EXPECT_GT(left.x(), 0.1);
  Avoidance other(true);
  EXPECT_LT(other.Limit({0.8, 0, 0}, Wall(kNose + 0.8, -0.1, 0.6), kDt).y(), -0.05);
}

TEST_F(AvoidanceTest, KeepsToTheSideOnWhichItGoesRound) {
  ASSERT_GT(Limit({0.8, 0, 0}, Wall(kNose + 0.8, -0.4, 0.1)).y(), 0);
  EXPECT_GT(Limit({0.8, 0, 0}, Wall(kNose + 0.8, -0.15, 0.35)).y(), 0) << "the right is shorter";
  for (int i = 0; i < 1000; ++i) Limit({0.8, 0, 0}, Seen({}));
  EXPECT_LT(Limit({0.8, 0, 0}, Wall(kNose + 0.8, -0.15, 0.35)).y(), 0) << "that was long ago";
}

TEST_F(AvoidanceTest, StopsOnWheelsWhichCannotGoAside) {
  Avoidance wheels(false);
  const Vector3d v = wheels.Limit({0.8, 0, 0}, Wall(kNose + 0.5, -0.2, 0.1), kDt);
  EXPECT_EQ(v.y(), 0);
  EXPECT_NEAR(v.x(), 0.1, 1e-6);
}

TEST_F(AvoidanceTest, WaitsForTheFirstCloudAndThenGoesBlind) {
  const Vector3d wish(0.5, 0, 0.1);
  const auto waits = [&] {
    for (int steps = 0;; ++steps) {
      const Vector3d v = Limit(wish, {});
      if (v == wish || steps > 1000) return steps;
      EXPECT_EQ(v, Vector3d(0, 0, 0.1));
    }
  };
  EXPECT_GT(waits(), 50);
  EXPECT_EQ(waits(), 0);
  avoidance_.Rest();
  EXPECT_GT(waits(), 50);
}

}  // namespace
}  // namespace understudy::motion
