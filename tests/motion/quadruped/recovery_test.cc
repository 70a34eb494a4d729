// Tests Recovery Stand from any fallen pose.

#include "motion/quadruped/recovery.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/motion/quadruped/rig.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

constexpr double kPatience = 25;  // s

// Any orientation, joints anywhere within 0.8 rad of lying: the same every time.
robot::PoseSpec Fallen(const robot::RobotSpec& spec, const QuadrupedFigures& figures,
                       std::mt19937* random) {
  const auto between = [random](double low, double high) {
    return low + (high - low) * static_cast<double>((*random)()) / 4294967295.0;
  };
  robot::PoseSpec pose = spec.lying;
  for (std::size_t i = 0; i < 12; ++i) {
    const LegFigures& leg = figures.legs[i / 3];
    pose.q[i] = std::clamp(pose.q[i] + between(-0.8, 0.8), leg.low[i % 3], leg.high[i % 3]);
  }
  double norm = 2;
  while (norm > 1 || norm < 0.1) {
    norm = 0;
    for (double& x : pose.quat) {
      x = between(-1, 1);
      norm += x * x;
    }
  }
  for (double& x : pose.quat) x /= std::sqrt(norm);
  pose.height = 0.05;
  return pose;
}

class RecoveryTest : public testing::Test {
 protected:
  static void ExpectGetsUp(config::Config config, const robot::PoseSpec& pose,
                           const std::string& what) {
    config.robots[0].spec.hanging = pose;  // from a crane that is not there
    config.robots[0].spec.motion.quadruped.stands_up = false;
    QuadrupedRig rig(config);
    rig.Request("reset", {{"pose", "hanging"}});
    rig.Request("crane.release");
    rig.Run(0.7);
    ASSERT_EQ(rig.Ask(goal::RecoveryStand{}), authority::MotionVerdict::kTaken) << what;
    EXPECT_TRUE(rig.RunUntil(kStanding, kPatience)) << what;
    rig.Run(1.5);
    EXPECT_EQ(rig.state().id, kStanding) << what;
    EXPECT_LT(rig.tilt(), 0.05) << what;
    EXPECT_NEAR(rig.height(), rig.spec().motion.quadruped.stand_height, 0.02) << what;
  }
};

// Twenty random poses of a Go2, in four parts; a few of the others.
struct Case {
  const char* robot;
  unsigned seed;
  int poses;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.robot << " " << c.seed; }

class RandomRecoveryTest : public RecoveryTest, public testing::WithParamInterface<Case> {};

TEST_P(RandomRecoveryTest, GetsUpFromRandomPoses) {
  const config::Config config = ConfigOf(GetParam().robot);
  const QuadrupedFigures figures = ReadQuadruped(QuadrupedRig(config).world().robot());
  std::mt19937 random(GetParam().seed);
  for (int i = 0; i < GetParam().poses; ++i) {
    ExpectGetsUp(config, Fallen(config.robots[0].spec, figures, &random), std::to_string(i));
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, RandomRecoveryTest,
                         testing::Values(Case{"go2", 1, 5}, Case{"go2", 2, 5}, Case{"go2", 3, 5},
                                         Case{"go2", 4, 5}, Case{"go2w", 1, 4}, Case{"b2", 1, 4},
                                         Case{"b2w", 1, 4}, Case{"a2", 1, 4}),
                         [](const auto& test) {
                           return std::string(test.param.robot) + "_" +
                                  std::to_string(test.param.seed);
                         });

class RobotRecoveryTest : public RecoveryTest, public testing::WithParamInterface<std::string> {};

TEST_P(RobotRecoveryTest, GetsUpFromItsBackAndBothSides) {
  const config::Config config = ConfigOf(GetParam());
  for (const double roll : {3.14159, 1.5708, -1.5708}) {
    robot::PoseSpec pose = config.robots[0].spec.lying;
    pose.quat = {std::cos(roll / 2), std::sin(roll / 2), 0, 0};
    pose.height = 0.05;
    ExpectGetsUp(config, pose, std::to_string(roll));
  }
}

TEST_P(RobotRecoveryTest, StandsUpFromLying) {
  const config::Config config = ConfigOf(GetParam());
  ExpectGetsUp(config, config.robots[0].spec.lying, "lying");
}

INSTANTIATE_TEST_SUITE_P(Robots, RobotRecoveryTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& test) { return test.param; });

TEST_F(RecoveryTest, EndsStandingFromEveryState) {
  QuadrupedRig rig("go2");
  rig.StandUp();
  EXPECT_EQ(rig.Ask(goal::RecoveryStand{}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(rig.RunUntil(kStanding, 1));
  rig.Run(1);
  rig.Ask(goal::Sit{});
  rig.Run(2);
  EXPECT_EQ(rig.Ask(goal::RecoveryStand{}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(rig.RunUntil(kStanding, 3));
  rig.Ask(goal::StandUp{});
  rig.Run(2);
  rig.Ask(goal::StandDown{});
  rig.Run(0.5);
  EXPECT_EQ(rig.Ask(goal::RecoveryStand{}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(rig.RunUntil(kStanding, 8));
}

TEST_F(RecoveryTest, SaysThatItIsUnderWay) {
  QuadrupedRig rig("go2");
  rig.Start("lying");
  rig.Ask(goal::RecoveryStand{});
  EXPECT_EQ(rig.state().id, 2006);
  EXPECT_EQ(rig.state().mode, 8);
  EXPECT_EQ(rig.Ask(goal::Move{0.3, 0, 0, 1}), authority::MotionVerdict::kNotNow);
  EXPECT_EQ(rig.Ask(goal::Damp{}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(rig.state().id, 1001);
}

TEST_F(RecoveryTest, DoesOnceItStandsWhatItIsAskedForMeanwhile) {
  for (const auto& [order, id] :
       {std::pair{authority::MotionGoal(goal::BalanceStand{}), int{kBalance}},
        std::pair{authority::MotionGoal(goal::StandUp{}), int{kLocked}}}) {
    QuadrupedRig rig("go2");
    rig.Start("lying");
    rig.Ask(goal::RecoveryStand{});
    ASSERT_EQ(rig.state().id, 2006);
    EXPECT_EQ(rig.Ask(order), authority::MotionVerdict::kTaken);
    rig.Run(10);
    EXPECT_EQ(rig.state().id, id);
  }
}

class AutoRecoveryTest : public testing::Test {
 protected:
  void SetUp() override {
    rig.StandUp();
    rig.BalanceStand();
  }
  void Topple() {
    rig.Push({0, 900, 0}, 0.2);
    ASSERT_TRUE(rig.RunUntil(kDamped, 3));
    ASSERT_GT(rig.tilt(), 1.0);
  }
  static constexpr int kDamped = 1001, kRecovering = 2006;
  QuadrupedRig rig{"go2"};
};

TEST_F(AutoRecoveryTest, LeavesAFallenRobotDampedUntilItIsSwitchedOn) {
  Topple();
  rig.Run(5);
  EXPECT_EQ(rig.state().id, kDamped);
  EXPECT_EQ(rig.Ask(goal::AutoRecovery{true}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(rig.RunUntil(kRecovering, 0.1));
}

TEST_F(AutoRecoveryTest, GetsUpByItselfOnceItIsSwitchedOn) {
  rig.Ask(goal::AutoRecovery{true});
  Topple();
  EXPECT_TRUE(rig.RunUntil(kStanding, kPatience));
  rig.Run(1.5);
  EXPECT_LT(rig.tilt(), 0.05);
}

TEST_F(AutoRecoveryTest, StaysDownAfterDampAndAfterItIsSwitchedOff) {
  rig.Ask(goal::AutoRecovery{true});
  Topple();
  rig.Ask(goal::Damp{});
  rig.Run(3);
  EXPECT_EQ(rig.state().id, kDamped);
  rig.Ask(goal::RecoveryStand{});
  ASSERT_TRUE(rig.RunUntil(kStanding, kPatience));
  rig.Ask(goal::AutoRecovery{false});
  Topple();
  rig.Run(3);
  EXPECT_EQ(rig.state().id, kDamped);
}

}  // namespace
}  // namespace understudy::motion
