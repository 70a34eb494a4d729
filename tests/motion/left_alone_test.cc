// Checks that a robot without commands stays as it is, for 100 s; UNDERSTUDY_REST_SECONDS=300 has
// it rest longer.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/motion/rig.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

// Joints may creep by so much in 300 s, and in less time by as much less. A base sways, and that
// does not grow.
constexpr double kWhole = 300, kJoint = 0.02, kBase = 0.002;  // s, rad, m

double Seconds() { return RestSeconds(100); }

double Share() { return Seconds() / kWhole; }

struct Stillness {
  std::vector<double> q;
  Eigen::Vector3d base;

  explicit Stillness(const MotionRig& rig)
      : q(rig.world().robot().q().begin(), rig.world().robot().q().end()),
        base(rig.world().robot().base().p_WB) {}

  void ExpectKept(const MotionRig& rig) const {
    const Stillness now(rig);
    for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(now.q[i], q[i], kJoint * Share()) << i;
    EXPECT_LT((now.base - base).norm(), kBase);
  }
};

class LeftAloneTest : public testing::TestWithParam<std::string> {};

using QuadrupedTest = LeftAloneTest;

TEST_P(QuadrupedTest, LiesStill) {
  MotionRig rig(
      ConfigOf(GetParam(), {"robot.motion.quadruped.stands_up=false", "start.pose=lying"}));
  ASSERT_TRUE(rig.Run(2));
  const Stillness before(rig);
  ASSERT_TRUE(rig.Run(Seconds()));
  before.ExpectKept(rig);
}

TEST_P(QuadrupedTest, StandsStillUnderItsService) {
  MotionRig rig(ConfigOf(GetParam(), {"start.pose=standing"}));
  ASSERT_TRUE(rig.Run(5));
  const Stillness before(rig);
  ASSERT_TRUE(rig.Run(Seconds()));
  before.ExpectKept(rig);
}

// What the vendor's example commands: crouch, stand, hold, crouch, and then no more.
TEST(LeftAloneAfterwardsTest, AGo2LiesStillAfterTheVendorsStandExample) {
  constexpr double kCrouched = 1.5, kRisen = 3, kHeld = 5, kDone = 7;  // s
  const std::vector<double> crouch{0,    1.36, -2.65, 0,   1.36, -2.65,
                                   -0.2, 1.36, -2.65, 0.2, 1.36, -2.65};
  const std::vector<double> stand{0, 0.67, -1.3, 0, 0.67, -1.3, 0, 0.67, -1.3, 0, 0.67, -1.3};
  const std::vector<double> rest{-0.35, 1.36, -2.65, 0.35, 1.36, -2.65,
                                 -0.5,  1.36, -2.65, 0.5,  1.36, -2.65};
  MotionRig rig(ConfigOf("go2", {"motion.service=none"}));
  const Stillness start(rig);
  robot::RobotCommand command;
  const auto move = [&](const std::vector<double>& from, const std::vector<double>& to,
                        double seconds) {
    const double begin = rig.time();
    while (rig.time() < begin + seconds) {
      const double share = (rig.time() - begin) / seconds;
      command.motors.clear();
      for (std::size_t i = 0; i < from.size(); ++i) {
        command.motors.push_back(
            {.enabled = true, .q = std::lerp(from[i], to[i], share), .kp = 60, .kd = 5});
      }
      rig.port().Send(command);
      ASSERT_TRUE(rig.Run(0.002));
    }
  };
  move(start.q, crouch, kCrouched);
  move(crouch, stand, kRisen - kCrouched);
  move(stand, stand, kHeld - kRisen);
  EXPECT_GT(rig.height(), 0.25);
  move(stand, rest, kDone - kHeld);
  ASSERT_TRUE(rig.Run(20));  // the legs open under motors that only brake
  EXPECT_LT(rig.height(), 0.15);
  const Stillness before(rig);
  ASSERT_TRUE(rig.Run(Seconds()));
  before.ExpectKept(rig);
}

INSTANTIATE_TEST_SUITE_P(Robots, QuadrupedTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& robot) { return robot.param; });

using HumanoidTest = LeftAloneTest;

TEST_P(HumanoidTest, HangsWithoutTurningOrSwinging) {
  MotionRig rig(ConfigOf(GetParam()));
  const int base = rig.world().robot().Body(rig.spec().base_body);
  // Of the base: an inertial unit may be in the trunk, which the straps hold.
  const auto yaw = [&] {
    const Eigen::Vector3d ahead =
        rig.world().Point(base, {1, 0, 0}).p_WP - rig.world().Point(base, {0, 0, 0}).p_WP;
    return std::atan2(ahead.y(), ahead.x());
  };
  const double begun = yaw();
  ASSERT_TRUE(rig.Run(30));
  Eigen::Vector3d low = rig.rpy(), high = low;
  double turned = 0;
  rig.watch = [&] {
    const Eigen::Vector3d now = rig.rpy();
    turned = std::max({turned, std::abs(now.z()), std::abs(yaw() - begun)});
    low = low.cwiseMin(now);
    high = high.cwiseMax(now);
  };
  ASSERT_TRUE(rig.Run(Seconds() - 30));
  EXPECT_LT(turned, kDegree * Share());
  EXPECT_LT((high - low).x() / 2, 0.2 * kDegree);
  EXPECT_LT((high - low).y() / 2, 0.2 * kDegree);
}

INSTANTIATE_TEST_SUITE_P(Robots, HumanoidTest, testing::ValuesIn(test::Humanoids()),
                         [](const auto& robot) { return robot.param; });

}  // namespace
}  // namespace understudy::motion
