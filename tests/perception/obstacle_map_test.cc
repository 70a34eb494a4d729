#include "perception/obstacle_map.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/allocations.h"

namespace understudy::perception {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBaseHeight = 0.32;

class ObstacleMapTest : public testing::Test {
 protected:
  void Begin(double x = 0, double y = 0, double yaw = 0, double altitude = 0) {
    base_.p_OB = {x, y, kBaseHeight};
    base_.R_OB = Eigen::AngleAxisd(yaw, Vector3d::UnitZ());
    map_.Begin(base_, altitude);
  }
  void Add(const Vector3d& p) { map_.Add(p, base_.R_OB.conjugate() * (p - base_.p_OB)); }
  // Ground of that slope ahead.
  void AddGround(double slope = 0) {
    for (double x = -2; x <= 2; x += 0.04) {
      for (double y = -1; y <= 1; y += 0.04) Add({x, y, slope * x});
    }
  }
  // A face across the way, of points 2 cm apart.
  void AddFace(double x, double low, double high, double half = 0.3) {
    for (double y = -half; y <= half; y += 0.02) {
      for (double z = low; z <= high; z += 0.02) Add({x, y, z});
    }
  }
  robot::SeenObstacles Read() {
    robot::SeenObstacles seen;
    map_.Read(&seen);
    return seen;
  }
  // The nearest one straight ahead; 9 if there is none.
  double Ahead() {
    double nearest = 9;
    const robot::SeenObstacles seen = Read();
    for (const Vector2d& at : seen.all()) {
      if (std::abs(at.y()) < 0.1 && at.x() > 0) nearest = std::min(nearest, at.x());
    }
    return nearest;
  }

  ObstacleMap map_;
  robot::LegOdometry base_;
};

TEST_F(ObstacleMapTest, KnowsNothingBeforeTheFirstCloud) {
  EXPECT_FALSE(Read().known);
  Begin();
  EXPECT_TRUE(Read().known);
  EXPECT_EQ(Read().count, 0U);
  map_.Clear();
  EXPECT_FALSE(Read().known);
}

TEST_F(ObstacleMapTest, ForgetsWhatHasGoneWhereItSeesTheGroundAgain) {
  Begin();
  AddGround();
  AddFace(1.2, 0, 0.5);
  for (int cloud = 0; cloud < 14; ++cloud) {
    Begin();
    AddGround();
  }
  EXPECT_NEAR(Ahead(), 1.2, 0.06) << "a second later it may be there still";
  for (int cloud = 0; cloud < 20; ++cloud) {
    Begin();
    AddGround();
  }
  EXPECT_EQ(Ahead(), 9) << "nothing has been seen there for two seconds but ground";
}

TEST_F(ObstacleMapTest, HasAWallWhereItStands) {
  Begin();
  AddGround();
  AddFace(1.2, 0, 0.5);
  EXPECT_NEAR(Ahead(), 1.2, 0.06);
}

TEST_F(ObstacleMapTest, LeavesOutGroundSlopesAndWhatTheRobotStepsOn) {
  Begin();
  AddGround(std::tan(0.2));
  AddFace(1.6, std::tan(0.2) * 1.6, std::tan(0.2) * 1.6 + 0.06);
  EXPECT_EQ(Read().count, 0U);
}

TEST_F(ObstacleMapTest, HasWhatIsHigherThanAStep) {
  Begin();
  AddGround();
  AddFace(0.8, 0, 0.2);
  EXPECT_NEAR(Ahead(), 0.8, 0.06);
}

TEST_F(ObstacleMapTest, HasWhatHangsOverGroundThatWasSeenBesideIt) {
  Begin();
  for (double y = -0.3; y <= 0.3; y += 0.04) Add({0.86, y, 0});
  AddFace(1, 0.3, 0.32);
  EXPECT_NEAR(Ahead(), 1, 0.06);
}

TEST_F(ObstacleMapTest, HasTheNearestOfTwoWallsOnEachSide) {
  Begin();
  for (const double x : {-2.0, -1.2, 1.2, 2.0}) AddFace(x, 0, 0.5);
  EXPECT_NEAR(Ahead(), 1.2, 0.06);
  double behind = -9;
  const robot::SeenObstacles seen = Read();
  for (const Vector2d& at : seen.all()) {
    if (std::abs(at.y()) < 0.1 && at.x() < 0) behind = std::max(behind, at.x());
    EXPECT_LT(at.norm(), 1.4);
  }
  EXPECT_NEAR(behind, -1.2, 0.06);
}

TEST_F(ObstacleMapTest, HasATablesEdgeAndNotWhatItPassesUnder) {
  Begin();
  AddGround();
  AddFace(1, 0.4, 0.44);
  EXPECT_NEAR(Ahead(), 1, 0.06);
  map_.Clear();
  Begin();
  AddGround();
  AddFace(1, 0.6, 0.7);
  EXPECT_EQ(Ahead(), 9);
}

TEST_F(ObstacleMapTest, LeavesOutTheRobotsOwnLegs) {
  Begin();
  AddGround();
  AddFace(0.3, 0, 0.3, 0.2);
  EXPECT_EQ(Read().count, 0U);
}

TEST_F(ObstacleMapTest, KnowsASlopeAgainThatItClimbs) {
  const double slope = std::tan(0.15);
  for (double x = 0; x < 1.5; x += 0.1) {
    Begin(x, 0, 0, slope * x);
    for (double ahead = 0.5; ahead < 2; ahead += 0.04) {
      for (double y = -0.2; y <= 0.2; y += 0.04) Add({x + ahead, y, slope * ahead});
    }
    EXPECT_EQ(Read().count, 0U) << x;
  }
}

TEST_F(ObstacleMapTest, ForgetsAfterTwoSeconds) {
  Begin();
  AddGround();
  AddFace(1, 0, 0.5);
  for (int i = 0; i < 29; ++i) Begin();
  EXPECT_NEAR(Ahead(), 1, 0.06);
  Begin();
  EXPECT_EQ(Ahead(), 9);
}

TEST_F(ObstacleMapTest, TellsPlacesFromWhereTheBaseIsNow) {
  Begin();
  AddGround();
  AddFace(2, 0, 0.5, 0.1);
  Begin(1.5, -0.5, M_PI / 2);
  ASSERT_GT(Read().count, 0U);
  const robot::SeenObstacles seen = Read();
  for (const Vector2d& at : seen.all()) {
    EXPECT_NEAR(at.y(), -0.5, 0.06) << "to the right of one that has turned left";
    EXPECT_NEAR(at.x(), 0.5, 0.2);
  }
}

TEST_F(ObstacleMapTest, DoesNotTakeOneEndOfItsRingForTheOther) {
  Begin();
  AddGround();
  AddFace(1, 0, 0.5);
  Begin(5.12, 0);  // 64 cells on
  EXPECT_EQ(Read().count, 0U);
  AddFace(6.12, 0, 0.5);
  EXPECT_NEAR(Ahead(), 1, 0.06) << "it is what is there now";
}

TEST_F(ObstacleMapTest, AllocatesNothing) {
  robot::SeenObstacles seen;
  const std::uint64_t before = test::AllocationsOfThisThread();
  Begin();
  AddFace(1, 0, 0.5);
  map_.Read(&seen);
  map_.Clear();
  EXPECT_EQ(test::AllocationsOfThisThread(), before);
}

}  // namespace
}  // namespace understudy::perception
