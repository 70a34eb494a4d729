#include "physics/crane.h"

#include <gtest/gtest.h>

namespace understudy::physics {
namespace {

constexpr double kStep = 0.001;  // s

PointReading Hook(double z, double speed = 0) {
  return {.p_WP = {0, 0, z}, .v_WP_W = {0, 0, speed}};
}

// 100 N on 1000 N/m stretch the tether of 1 m by 0.1 m: hook at 2 m, anchor at 3.1 m.
class CraneTest : public testing::Test {
 protected:
  CraneTest() { crane_.Attach({0, 0, 2}, 100); }

  // The pull straight up.
  double Pull(const PointReading& hook) {
    const Eigen::Vector3d force = crane_.Step(hook, kStep);
    EXPECT_EQ(force.x(), 0);
    EXPECT_EQ(force.y(), 0);
    EXPECT_NEAR(force.z(), crane_.tension(), 1e-12);
    return force.z();
  }
  void Wind(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kStep); ++i) crane_.Step(Hook(2), kStep);
  }

  Crane crane_{{.length = 1, .stiffness = 1000, .damping = 10, .speed = 0.1}};
};

TEST_F(CraneTest, PullsNothingUntilItIsAttached) {
  Crane crane({});
  EXPECT_FALSE(crane.attached());
  EXPECT_EQ(crane.Step(Hook(-100), kStep), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(crane.tension(), 0);
}

TEST_F(CraneTest, CarriesTheWeightFromTheFirstStep) {
  EXPECT_TRUE(crane_.attached());
  EXPECT_EQ(crane_.length(), 1);
  EXPECT_NEAR(Pull(Hook(2)), 100, 1e-9);
}

TEST_F(CraneTest, PullsByItsStretch) {
  EXPECT_NEAR(Pull(Hook(1.9)), 200, 1e-9);
  EXPECT_NEAR(Pull(Hook(2.05)), 50, 1e-9);
}

TEST_F(CraneTest, NeverPushesWhenSlack) {
  EXPECT_EQ(Pull(Hook(2.1001)), 0);
  EXPECT_EQ(Pull(Hook(2.5)), 0);
  EXPECT_EQ(Pull(Hook(2.5, -100)), 0);  // no damping either
  EXPECT_EQ(crane_.tension(), 0);
}

TEST_F(CraneTest, DampsTheMotionWhileItIsTaut) {
  EXPECT_NEAR(Pull(Hook(2, -3)), 130, 1e-9);
  EXPECT_NEAR(Pull(Hook(2, 3)), 70, 1e-9);
}

TEST_F(CraneTest, NeverPushesAgainstAFastRise) { EXPECT_EQ(Pull(Hook(2, 50)), 0); }

// The anchor is a slack tether's length above the hook and there is no direction to pull in.
TEST_F(CraneTest, PullsNothingAtTheAnchor) {
  EXPECT_EQ(Pull(Hook(3.1)), 0);
  EXPECT_EQ(Pull(Hook(3.1, -1)), 0);
}

TEST_F(CraneTest, PullsTowardsTheAnchorFromTheSide) {
  crane_.Attach({0, 0, 0}, 0);  // anchor at 1 m
  const Eigen::Vector3d force = crane_.Step({.p_WP = {-4, 0, -2}, .v_WP_W = {0, 0, 0}}, kStep);
  // 4 m aside and 3 m down: 5 m away, 4 m of stretch
  EXPECT_LT((force - Eigen::Vector3d(3200, 0, 2400)).norm(), 1e-9);
}

TEST_F(CraneTest, LowersAtItsSpeed) {
  crane_.Lower(0.2);
  Wind(1);
  EXPECT_NEAR(crane_.length(), 1.1, 1e-9);
  Wind(1);
  EXPECT_NEAR(crane_.length(), 1.2, 1e-9);
  Wind(1);
  EXPECT_NEAR(crane_.length(), 1.2, 1e-9);
}

TEST_F(CraneTest, RaisesAtItsSpeed) {
  crane_.Lower(-0.1);
  Wind(0.5);
  EXPECT_NEAR(crane_.length(), 0.95, 1e-9);
  Wind(1);
  EXPECT_NEAR(crane_.length(), 0.9, 1e-9);
}

TEST_F(CraneTest, AddsUpWhatItIsTold) {
  crane_.Lower(0.2);
  crane_.Lower(-0.1);
  Wind(3);
  EXPECT_NEAR(crane_.length(), 1.1, 1e-9);
}

TEST_F(CraneTest, StopsTheWinchFiveCentimetresFromTheAnchor) {
  crane_.Lower(-10);
  Wind(20);
  EXPECT_NEAR(crane_.length(), 0.05, 1e-9);
}

TEST_F(CraneTest, LowersAtOnceAfterItWasRaisedTooFar) {
  crane_.Lower(-10);
  Wind(20);
  crane_.Lower(0.1);
  Wind(1.5);
  EXPECT_NEAR(crane_.length(), 0.15, 1e-9);
}

TEST_F(CraneTest, LetsGo) {
  EXPECT_GT(Pull(Hook(2)), 0);
  crane_.Release();
  EXPECT_FALSE(crane_.attached());
  EXPECT_EQ(crane_.tension(), 0);  // at once
  EXPECT_EQ(Pull(Hook(1)), 0);
}

TEST_F(CraneTest, AttachesAfreshWithItsOwnLength) {
  crane_.Lower(0.5);
  Wind(1);
  crane_.Attach({7, 8, 9}, 100);
  Wind(1);
  EXPECT_EQ(crane_.length(), 1);
  EXPECT_LT(
      (crane_.Step({.p_WP = {7, 8, 9}, .v_WP_W = {0, 0, 0}}, kStep) - Eigen::Vector3d(0, 0, 100))
          .norm(),
      1e-9);
}

}  // namespace
}  // namespace understudy::physics
