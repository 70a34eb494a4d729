#include "perception/clearance.h"

#include <vector>

#include <gtest/gtest.h>

namespace understudy::perception {
namespace {

using Eigen::Vector3d;

constexpr double kHeight = 0.3;

void Add(const std::vector<Vector3d>& points, Clearance* clearance) {
  clearance->Add(
      points.size(), [&](std::size_t i) { return points[i]; }, kHeight);
}

// A wall's points ahead, each a centimetre before or behind it.
std::vector<Vector3d> Wall(double x) {
  std::vector<Vector3d> points;
  for (int i = -20; i <= 20; ++i) {
    points.emplace_back(x + (i % 2 == 0 ? 0.01 : -0.01), 0.01 * i, 0.01 * i);
  }
  return points;
}

TEST(ClearanceTest, IsTheDistanceAheadToTheLeftAndToTheRight) {
  Clearance clearance;
  auto points = Wall(1.5);
  points.emplace_back(0.1, 0.8, 0);
  points.emplace_back(-0.1, -0.6, 0);
  Add(points, &clearance);
  EXPECT_NEAR(clearance.Read().x(), 1.5, 0.011);
  EXPECT_NEAR(clearance.Read().y(), 0.8, 1e-9);
  EXPECT_NEAR(clearance.Read().z(), 0.6, 1e-9);
}

TEST(ClearanceTest, EndsAtTwoMetres) {
  Clearance clearance;
  EXPECT_EQ(clearance.Read(), Vector3d(2, 2, 2));
  Add(Wall(3), &clearance);
  EXPECT_EQ(clearance.Read(), Vector3d(2, 2, 2));
}

TEST(ClearanceTest, LeavesOutGroundLegsAndWhatTheRobotPassesUnder) {
  Clearance clearance;
  Add({{1, 0, -0.29}, {0.2, 0.1, -0.1}, {1, 0, 0.5}, {-1, 0, 0}, {1, 0.5, 0}}, &clearance);
  EXPECT_EQ(clearance.Read(), Vector3d(2, 2, 2));
}

TEST(ClearanceTest, RemembersTheLastFiveClouds) {
  Clearance clearance;
  Add(Wall(1), &clearance);
  for (int i = 0; i < 4; ++i) Add({}, &clearance);
  EXPECT_NEAR(clearance.Read().x(), 1, 0.02);
  Add({}, &clearance);
  EXPECT_EQ(clearance.Read().x(), 2);
  Add(Wall(1), &clearance);
  clearance.Clear();
  EXPECT_EQ(clearance.Read().x(), 2);
}

}  // namespace
}  // namespace understudy::perception
