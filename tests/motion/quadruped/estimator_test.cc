// Compares a quadruped's estimate of velocity and height with the truth.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/motion/quadruped/rig.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

// Root mean squares over the steps watched.
struct Error {
  double v = 0, height = 0;  // m/s, m
};

class EstimatorTest : public testing::TestWithParam<std::string> {
 protected:
  EstimatorTest() { rig_.BalanceStand(); }

  // Of what the service and the simulation say in one sample.
  template <class Act>
  static Error Watch(QuadrupedRig* rig, const Act& act) {
    double v = 0, height = 0;
    int steps = 0;
    rig->watch = [&] {
      const robot::RobotState& said = rig->robot().sampled();
      v += (said.motion->v_WB_W - said.base.v_WB_W).squaredNorm();
      height += std::pow(said.motion->body_height - said.base.p_WB.z(), 2);
      ++steps;
    };
    act();
    rig->watch = {};
    return {std::sqrt(v / steps), std::sqrt(height / steps)};
  }
  template <class Act>
  Error Watch(const Act& act) {
    return Watch(&rig_, act);
  }

  double mass() { return rig_.world().robot().weight() / 9.81; }

  QuadrupedRig rig_{GetParam()};
};

TEST_P(EstimatorTest, KnowsThatItStands) {
  const Error error = Watch([&] { rig_.Run(2); });
  EXPECT_LT(error.v, 0.005);
  EXPECT_LT(error.height, 0.003);
}

TEST_P(EstimatorTest, FollowsABodyThatIsPushed) {
  const Error error = Watch([&] {
    for (const Eigen::Vector3d& way : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -1, 0)}) {
      rig_.Push(3 * mass() * way, 0.1);  // 0.3 N·s/kg
      rig_.Run(0.9);
    }
  });
  EXPECT_LT(error.v, 0.02);
  EXPECT_LT(error.height, 0.005);
}

TEST_P(EstimatorTest, FollowsABodyThatGesturesOnThreeFeet) {
  const Error error = Watch([&] {
    ASSERT_EQ(rig_.Ask(goal::Gesture{}), authority::MotionVerdict::kTaken);
    rig_.Run(6);
  });
  EXPECT_LT(error.v, 0.02);
  EXPECT_LT(error.height, 0.005);
}

TEST_P(EstimatorTest, FollowsABodyThatRisesFromTheGround) {
  const Error error = Watch([&] { rig_.StandUp(); });
  EXPECT_LT(error.v, 0.05);
}

// A body on the ground bears no foot: without the rest the accelerometer's bias sinks it for ever.
TEST_P(EstimatorTest, StaysWhereItIsWhileItLies) {
  // What the odometer of the profile drifts by in 30 s comes on top.
  for (const auto& [profile, most] : {std::pair("nominal", 0.01), std::pair("harsh", 0.15)}) {
    QuadrupedRig rig(GetParam(), {std::string("profile=") + profile});
    rig.StandUp();
    ASSERT_EQ(rig.Ask(goal::StandDown{}), authority::MotionVerdict::kTaken);
    rig.Run(5);
    const robot::MotionState before = *rig.robot().sampled().motion;
    rig.Run(30);
    const robot::MotionState& after = *rig.robot().sampled().motion;
    EXPECT_LT((after.p_WB - before.p_WB).norm(), most) << profile;
    EXPECT_NEAR(after.body_height, before.body_height, most / 10) << profile;
  }
}

TEST_P(EstimatorTest, FollowsABodyThatFliesWhicheverWayItFaces) {
  config::Config turned = ConfigOf(GetParam());
  turned.robots[0].spec.standing.quat = {std::cos(1), 0, 0, std::sin(1)};
  QuadrupedRig rig(turned);
  rig.Start("standing");
  rig.Run(1);
  double highest = 0;
  const Error error = Watch(&rig, [&] {
    rig.Push(mass() * Eigen::Vector3d(3, -2, 22), 0.1);
    for (int i = 0; i < 20; ++i) {
      rig.Run(0.01);
      highest = std::max(highest, rig.height());
    }
  });
  EXPECT_GT(highest, rig.spec().motion.quadruped.stand_height + 0.1);
  EXPECT_LT(error.v, 0.1);
  EXPECT_LT(error.height, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Robots, EstimatorTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy::motion
