// Standing balance in simulated physics: from the crane, against pushes, with noise, friction and
// drives unlike those it was made with.

#include <algorithm>
#include <cmath>

#include "tests/motion/humanoid/fixture.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

int Balanced(const HumanoidRig& rig) { return rig.spec().motion.humanoid.balance.front(); }

class HumanoidStandTest : public test::MujocoTest,
                          public testing::WithParamInterface<std::string> {};

// Pushes of an impulse [N·s] on the torso.
void SurvivesPushes(HumanoidRig* rig, double impulse) {
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0),
                                           Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)}) {
    ASSERT_TRUE(rig->Push(impulse / 0.1 * direction, 0.1));
    ASSERT_TRUE(rig->Run(3));
    ASSERT_TRUE(rig->standing()) << direction.transpose();
    EXPECT_LT(rig->world().robot().tilt(), 0.03) << direction.transpose();
  }
}

TEST_P(HumanoidStandTest, StandsReleasedFromTheCrane) {
  HumanoidRig rig(GetParam(), 0.002);
  rig.SetDown(Balanced(rig));
  ASSERT_TRUE(rig.Run(20));
  EXPECT_EQ(rig.state().id, Balanced(rig));
  EXPECT_TRUE(rig.standing());
  EXPECT_LT(rig.fastest(), 0.02);
  EXPECT_NEAR(rig.Load(), rig.world().robot().weight(), 0.003 * rig.world().robot().weight());
}

TEST_P(HumanoidStandTest, TakesPushesOfFiveNewtonSeconds) {
  HumanoidRig rig(GetParam(), 0.002);
  rig.Start("standing");
  rig.Run(1);
  ASSERT_EQ(rig.SetFsm(Balanced(rig)), authority::MotionVerdict::kTaken);
  rig.Run(2);
  SurvivesPushes(&rig, 5);
}

TEST_P(HumanoidStandTest, StandsOnLockedJointsReleasedFromTheCrane) {
  HumanoidRig rig(GetParam(), 0.002);
  rig.SetDown(rig.spec().motion.humanoid.lock_stand);
  ASSERT_TRUE(rig.Run(5));
  EXPECT_TRUE(rig.standing());
}

class G1SquatTest : public test::MujocoTest, public testing::WithParamInterface<std::string> {};

TEST_P(G1SquatTest, SquatsBalancedAndRisesAgain) {
  HumanoidRig rig(GetParam(), 0.002);
  const int squat = rig.spec().motion.humanoid.balanced_squat;
  rig.Start("standing");
  rig.Run(1);
  ASSERT_EQ(rig.SetFsm(Balanced(rig)), authority::MotionVerdict::kTaken);
  rig.Run(1);
  ASSERT_EQ(rig.SetFsm(squat), authority::MotionVerdict::kTaken);
  rig.Run(7);
  EXPECT_LT(rig.height(), 0.7 * rig.spec().standing.height);
  EXPECT_LT(rig.world().robot().tilt(), 0.4);
  ASSERT_EQ(rig.SetFsm(squat), authority::MotionVerdict::kTaken);
  rig.Run(7);
  EXPECT_EQ(rig.state().id, Balanced(rig));
  EXPECT_TRUE(rig.standing());
}

// "g1 13" stands on the revision 13; gtest wants a name of letters.
std::string Name(std::string robot) {
  std::replace(robot.begin(), robot.end(), ' ', '_');
  return robot;
}

INSTANTIATE_TEST_SUITE_P(Robots, HumanoidStandTest, testing::ValuesIn(test::Humanoids()),
                         [](const auto& test) { return test.param; });

const auto kRevisions = testing::Values("g1 2", "g1 3", "g1 6", "g1 11", "g1 12", "g1 13", "g1 14",
                                        "g1 15", "g1 16", "g1_23dof 1", "g1_23dof 10");

INSTANTIATE_TEST_SUITE_P(Revisions, HumanoidStandTest, kRevisions,
                         [](const auto& test) { return Name(test.param); });
INSTANTIATE_TEST_SUITE_P(WithHands, HumanoidStandTest,
                         testing::Values("g1 inspire", "h1_2 inspire"),
                         [](const auto& test) { return Name(test.param); });
INSTANTIATE_TEST_SUITE_P(Revisions, G1SquatTest, kRevisions,
                         [](const auto& test) { return Name(test.param); });
INSTANTIATE_TEST_SUITE_P(Robots, G1SquatTest, testing::Values("g1", "g1_23dof"),
                         [](const auto& test) { return Name(test.param); });

class HumanoidLastsTest : public test::MujocoTest,
                          public testing::WithParamInterface<std::string> {};

TEST_P(HumanoidLastsTest, StandsForAMinute) {
  HumanoidRig rig(GetParam(), 0.002);
  rig.Start("standing");
  rig.Run(1);
  rig.SetFsm(Balanced(rig));
  rig.Run(5);
  const Eigen::Vector3d start = rig.world().robot().base().p_WB;
  ASSERT_TRUE(rig.Run(60));
  EXPECT_TRUE(rig.standing());
  EXPECT_LT((rig.world().robot().base().p_WB - start).norm(), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Robots, HumanoidLastsTest, testing::Values("g1", "h1"),
                         [](const auto& test) { return test.param; });

// Noise and lattices of the sensors; 1 ms, as the robot runs.
class HumanoidNoiseTest : public test::MujocoTest,
                          public testing::WithParamInterface<std::string> {};

TEST_P(HumanoidNoiseTest, DoesNotChatterOnWhatItsSensorsSay) {
  HumanoidRig rig(GetParam());
  rig.Start("standing");
  rig.Run(1);
  rig.SetFsm(Balanced(rig));
  rig.Run(2);
  rig.torque_change = 0;
  double fastest = 0;
  rig.watch = [&] { fastest = std::max(fastest, rig.fastest()); };
  rig.Run(3);
  const auto strongest = std::max_element(
      rig.spec().motors.begin(), rig.spec().motors.end(),
      [](const auto& a, const auto& b) { return a.torque_limit < b.torque_limit; });
  EXPECT_LT(rig.torque_change, 0.02 * strongest->torque_limit);
  EXPECT_LT(fastest, 0.1);
  SurvivesPushes(&rig, 5);
}

INSTANTIATE_TEST_SUITE_P(Robots, HumanoidNoiseTest, testing::Values("g1", "h1"),
                         [](const auto& test) { return test.param; });

struct Drives {
  double friction;  // N·m, of every joint
  double damping;   // of the ankles, as a share of what is commanded
};

class HumanoidDrivesTest : public test::MujocoTest, public testing::WithParamInterface<Drives> {};

TEST_P(HumanoidDrivesTest, StandsWithOtherDrives) {
  config::Config config = HumanoidConfig("g1", 0.002);
  config.robots[0].spec.dynamics.use = robot::DynamicsSource::kFitted;
  for (const robot::MotorSpec& motor : config.robots[0].spec.motors) {
    const bool ankle = motor.joint.find("ankle") != std::string::npos;
    config.robots[0].spec.dynamics.fitted.push_back({.slots = {motor.slot},
                                                     .frictionloss = GetParam().friction,
                                                     .kd_share = ankle ? GetParam().damping : 1});
  }
  HumanoidRig rig(config);
  rig.SetDown(501);
  ASSERT_TRUE(rig.Run(3));
  SurvivesPushes(&rig, 5);
}

INSTANTIATE_TEST_SUITE_P(FrictionAndDamping, HumanoidDrivesTest,
                         testing::Values(Drives{0, 0.5}, Drives{0, 1.5}, Drives{2, 0.5},
                                         Drives{2, 1.5}));

TEST(HumanoidHangsTest, BalancesInTheAirWithoutKicking) {
  HumanoidRig rig("g1");
  rig.Start("hanging");
  rig.SetFsm(1);
  rig.SetFsm(4);
  rig.Run(5);
  ASSERT_EQ(rig.SetFsm(501), authority::MotionVerdict::kTaken);
  double fastest = 0;
  rig.watch = [&] { fastest = std::max(fastest, rig.fastest()); };
  rig.Run(2);
  EXPECT_LT(fastest, 0.2);
  rig.watch = {};
  rig.robot().crane().Lower(0.4);
  rig.Run(4.5);
  rig.robot().crane().Release();
  rig.Run(3);
  EXPECT_TRUE(rig.standing());
}

}  // namespace
}  // namespace understudy::motion
