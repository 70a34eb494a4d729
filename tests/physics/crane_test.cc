#include "physics/crane.h"

#include <cmath>

#include <gtest/gtest.h>

namespace understudy::physics {
namespace {

constexpr double kStep = 0.001;  // s

// Both hooks, about a point.
Crane::Hooks HooksAbout(const Eigen::Vector3d& p_WP, const Eigen::Vector3d& v_WP_W = {0, 0, 0}) {
  const Eigen::Vector3d left(0, Crane::kHookOffset, 0);
  return {PointReading{.p_WP = p_WP + left, .v_WP_W = v_WP_W},
          PointReading{.p_WP = p_WP - left, .v_WP_W = v_WP_W}};
}

Crane::Hooks Hook(double z, double speed = 0) { return HooksAbout({0, 0, z}, {0, 0, speed}); }

Eigen::Vector3d Sum(const Crane::Pulls& pulls) { return pulls[0] + pulls[1]; }

// 100 N on 1000 N/m stretch the tether of 1 m by 0.1 m: hook at 2 m, anchor at 3.1 m.
class CraneTest : public testing::Test {
 protected:
  CraneTest() { crane_.Attach(Hook(2), 100); }

  // The pull straight up.
  double Pull(const Crane::Hooks& hooks) {
    const Eigen::Vector3d force = Sum(crane_.Step(hooks, kStep));
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
  EXPECT_EQ(Sum(crane.Step(Hook(-100), kStep)), Eigen::Vector3d(0, 0, 0));
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
  crane_.Attach(Hook(0), 0);  // anchors at 1 m
  const Eigen::Vector3d force = Sum(crane_.Step(HooksAbout({-4, 0, -2}), kStep));
  // 4 m aside and 3 m down: 5 m away, 4 m of stretch
  EXPECT_LT((force - Eigen::Vector3d(3200, 0, 2400)).norm(), 1e-9);
}

TEST_F(CraneTest, TurnsTheRobotBack) {
  const double turn = 0.2;  // rad to the left
  const Eigen::Vector3d left =
      Crane::kHookOffset * Eigen::Vector3d(-std::sin(turn), std::cos(turn), 0);
  const Eigen::Vector3d middle(0, 0, 2);
  const Crane::Pulls pulls = crane_.Step(
      {PointReading{.p_WP = middle + left}, PointReading{.p_WP = middle - left}}, kStep);
  const double moment = left.cross(pulls[0] - pulls[1]).z();
  EXPECT_LT(moment, 0);
  // Two threads: weight · offset² / length · sin(turn).
  EXPECT_NEAR(moment, -100 * 0.12 * 0.12 / 1.1 * std::sin(turn), 0.01);
}

TEST_F(CraneTest, DampsTheSwing) {
  EXPECT_NEAR(Sum(crane_.Step(HooksAbout({0, 0, 2}, {0.5, 0, 0}), kStep)).x(), -40, 1e-9);
  EXPECT_EQ(Sum(crane_.Step(HooksAbout({0, 0, 2.2}, {0.5, 0, 0}), kStep)).x(), 0);  // slack
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
  crane_.Attach(HooksAbout({7, 8, 9}), 100);
  Wind(1);
  EXPECT_EQ(crane_.length(), 1);
  EXPECT_LT((Sum(crane_.Step(HooksAbout({7, 8, 9}), kStep)) - Eigen::Vector3d(0, 0, 100)).norm(),
            1e-9);
}

}  // namespace
}  // namespace understudy::physics
