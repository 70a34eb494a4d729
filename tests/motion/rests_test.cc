// Checks that a quadruped which is left in a posture rests there, most by nothing but dry friction.
// Friction that yields let a hip creep by 0.33 rad. For 40 s, or as left_alone_test.cc says.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "tests/motion/rig.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

constexpr double kSettle = 5;                    // s
constexpr double kSinks = 30;                    // s in which a damped B2-W sinks
constexpr double kUsual = 40, kWhole = 300;      // s
constexpr double kJoint = 0.005, kBase = 0.005;  // rad, m
constexpr double kCreep = 0.02;                  // rad in kWhole

// Lets it settle, then expects that nothing moves.
void ExpectRest(MotionRig* rig, double settle) {
  ASSERT_TRUE(rig->Run(settle));
  const auto& body = rig->world().robot();
  const std::vector<double> q(body.q().begin(), body.q().end());
  const Eigen::Vector3d base = body.base().p_WB;
  const double seconds = RestSeconds(kUsual);
  ASSERT_TRUE(rig->Run(seconds));
  const double joint = std::max(kJoint, kCreep * seconds / kWhole);
  for (std::size_t i = 0; i < q.size(); ++i) {
    EXPECT_NEAR(body.q()[i], q[i], joint) << rig->spec().motors[i].joint;
  }
  EXPECT_LT((body.base().p_WB - base).norm(), kBase);
}

class GestureTest : public testing::TestWithParam<goal::GestureName> {};

// After a walk and a turn, so that it does not stand as the start pose has it.
TEST_P(GestureTest, AGo2DampedOutOfItRests) {
  MotionRig rig(ConfigOf("go2", {"start.pose=standing"}));
  ASSERT_TRUE(rig.Run(2));
  for (const goal::Move& move : {goal::Move{0.5, 0, 0, 3}, goal::Move{0, 0, -0.8, 2}}) {
    rig.Ask(move);
    ASSERT_TRUE(rig.Run(move.hold));
  }
  ASSERT_TRUE(rig.Run(2));
  ASSERT_EQ(rig.Ask(goal::Gesture{GetParam()}), authority::MotionVerdict::kTaken);
  ASSERT_TRUE(rig.Run(11));
  rig.Ask(goal::Damp{});
  ExpectRest(&rig, kSettle);
}

INSTANTIATE_TEST_SUITE_P(Go2, GestureTest,
                         testing::Values(goal::GestureName::kHello, goal::GestureName::kStretch,
                                         goal::GestureName::kContent, goal::GestureName::kDance2,
                                         goal::GestureName::kScrape, goal::GestureName::kHeart));

// As somebody with the remote does it.
TEST(RestsTest, AGo2DampedByTheRemoteAfterAWalkAndAGestureRests) {
  MotionRig rig(ConfigOf("go2", {"start.pose=standing"}));
  const auto sticks = [&](double ly, double rx, double seconds) {
    rig.Request("remote.sticks", {{"ly", ly}, {"rx", rx}});
    ASSERT_TRUE(rig.Run(seconds));
  };
  sticks(0, 0, 2);
  sticks(0.5, 0, 3);
  sticks(0, -0.8, 2);
  sticks(0, 0, 2);
  rig.Request("remote.press", {{"keys", "L1+A"}});
  ASSERT_TRUE(rig.Run(11));
  rig.Request("remote.press", {{"keys", "L2+B"}});
  ExpectRest(&rig, kSettle);
}

class QuadrupedRestsTest : public testing::TestWithParam<std::string> {};

TEST_P(QuadrupedRestsTest, DampedOutOfStanding) {
  MotionRig rig(ConfigOf(GetParam(), {"start.pose=standing"}));
  ASSERT_TRUE(rig.Run(2));
  rig.Ask(goal::Damp{});
  ExpectRest(&rig, kSinks);
}

TEST_P(QuadrupedRestsTest, StandingWithLockedJoints) {
  MotionRig rig(ConfigOf(GetParam(), {"start.pose=lying"}));
  ASSERT_TRUE(rig.Run(5));
  rig.Ask(goal::StandUp{});
  ASSERT_TRUE(rig.Run(5));
  ExpectRest(&rig, kSinks);
}

TEST_P(QuadrupedRestsTest, WithoutTorqueOnItsSide) {
  MotionRig rig(ConfigOf(GetParam(), {"start.pose=standing", "motion.service=none"}));
  ASSERT_TRUE(rig.Run(0.5));
  rig.Push({0, 3 * mj_getTotalmass(&rig.world().model()), 0}, 0.5);
  ExpectRest(&rig, kSinks);
}

INSTANTIATE_TEST_SUITE_P(Robots, QuadrupedRestsTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& robot) { return robot.param; });

}  // namespace
}  // namespace understudy::motion
