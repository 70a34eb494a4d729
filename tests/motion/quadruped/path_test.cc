#include "motion/quadruped/path.h"

#include <cmath>

#include <gtest/gtest.h>

namespace understudy::motion {
namespace {

using authority::goal::PathPoint;
using Eigen::Vector3d;

constexpr double kStep = 0.002;  // s

// Does at once what it is told.
struct Point {
  Vector3d here{0, 0, 0};
  double t = 0;

  void Go(PathFollower* path, double seconds) {
    for (const double end = t + seconds; t < end && !path->over(); t += kStep) {
      const Vector3d v = path->Step(kStep, here);
      const double c = std::cos(here.z()), s = std::sin(here.z());
      here += kStep * Vector3d(c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z());
    }
  }
};

TEST(PathFollowerTest, IsOverBeforeItBegins) {
  PathFollower path;
  EXPECT_TRUE(path.over());
  EXPECT_EQ(path.Step(kStep, {1, 2, 3}), Vector3d(0, 0, 0));
  path.Begin({}, {0, 0, 0});
  EXPECT_TRUE(path.over());
}

TEST(PathFollowerTest, PassesEachPointAtItsTime) {
  const PathPoint points[] = {{1, 0.5, 0, 0}, {2, 0.5, 0.5, 1}, {4, 0, 0.5, 1}};
  PathFollower path;
  Point robot;
  path.Begin(points, robot.here);
  for (const PathPoint& point : points) {
    robot.Go(&path, point.t - robot.t);
    EXPECT_LT((robot.here - Vector3d(point.x, point.y, point.yaw)).norm(), 0.01) << point.t;
  }
  robot.Go(&path, 1);
  EXPECT_TRUE(path.over());
}

TEST(PathFollowerTest, ComesBackToThePathFromBesideIt) {
  const PathPoint points[] = {{4, 2, 0, 0}};
  PathFollower path;
  Point robot;
  path.Begin(points, robot.here);
  robot.here = {-0.2, 0.3, 0.4};
  robot.Go(&path, 4);
  EXPECT_LT((robot.here - Vector3d(2, 0, 0)).norm(), 0.01);
}

TEST(PathFollowerTest, GoesTheShortWayRound) {
  PathFollower path;
  Point robot{.here = {0, 0, 3}};
  path.GoTo({0, 0, -3}, robot.here);
  EXPECT_GT(path.Step(kStep, robot.here).z(), 0);
  robot.Go(&path, 1);
  EXPECT_TRUE(path.over());
  EXPECT_NEAR(robot.here.z(), 2 * M_PI - 3, 0.1);
}

TEST(PathFollowerTest, GoesUnhurried) {
  PathFollower path;
  path.GoTo({3, 4, 0}, {0, 0, 0});
  EXPECT_NEAR(path.Step(kStep, {0, 0, 0}).norm(), 0.5, 0.01);
}

TEST(PathFollowerTest, GivesUpWhereItCannotArrive) {
  PathFollower path;
  path.GoTo({1, 0, 0}, {0, 0, 0});
  for (double t = 0; t < 2 + 2.9; t += kStep) path.Step(kStep, {0, 0, 0});
  EXPECT_FALSE(path.over());
  for (double t = 0; t < 0.2; t += kStep) path.Step(kStep, {0, 0, 0});
  EXPECT_TRUE(path.over());
}

TEST(PathFollowerTest, EndsWhenItIsTold) {
  PathFollower path;
  path.GoTo({1, 0, 0}, {0, 0, 0});
  path.End();
  EXPECT_TRUE(path.over());
}

}  // namespace
}  // namespace understudy::motion
