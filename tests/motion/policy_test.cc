// Controllers of motion services: the registry, and robots that walk by a policy.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>

#include "base/errors.h"
#include "base/files.h"
#include "config/load.h"
#include "motion/controllers.h"
#include "motion/policy_drive.h"
#include "tests/motion/humanoid/fixture.h"
#include "tests/motion/policy_rig.h"
#include "tests/motion/quadruped/rig.h"

namespace understudy::motion {
namespace {

using authority::MotionVerdict;
using ::testing::HasSubstr;

class PolicyMotionTest : public test::MujocoTest {};

std::vector<std::string> Joined(std::vector<std::string> settings,
                                const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

// The configuration of a G1 whose state 501 is a policy's.
config::Config G1With(const PolicyFiles& policy) {
  return ConfigOf("g1",
                  Joined(Plays("ai_sport", policy), {"robot.motion.humanoid.walk=[501, 801]"}));
}

std::string WhyNot(const std::string& robot, const std::vector<std::string>& settings) {
  try {
    ConfigOf(robot, settings);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST_F(PolicyMotionTest, AGo2WalksBehindSportMoveAndKeepsItsFeet) {
  const PolicyFiles policy = TrotOfGo2();
  WalkingRig rig("go2", Plays("mcf", policy));
  rig.Start("standing");
  rig.Run(1);
  ASSERT_EQ(rig.state().name, "standing");
  double tilt = 0;
  rig.watch = [&] { tilt = std::max(tilt, rig.tilt()); };
  const Eigen::Vector3d from = rig.world().robot().base().p_WB;
  rig.Walk({0.6, 0, 0}, 10);
  EXPECT_EQ(rig.state().name, "walking");
  EXPECT_EQ(rig.state().id, 100);
  EXPECT_EQ(rig.command().motors[0].kp, 60) << "the definition's";
  EXPECT_EQ(rig.command().motors[0].kd, 2);
  EXPECT_LT(tilt, 0.3);
  EXPECT_GT(rig.height(), 0.25);
  EXPECT_GT((rig.world().robot().base().p_WB - from).head<2>().norm(), 1);
  EXPECT_EQ(rig.Ask(goal::StopMove{}), MotionVerdict::kTaken);
  rig.Run(5);
  EXPECT_EQ(rig.state().name, "standing") << "the service's own stand";
  EXPECT_EQ(rig.command().motors[0].kp, rig.spec().motion.quadruped.kp);
  EXPECT_LT(rig.tilt(), 0.1);
}

TEST_F(PolicyMotionTest, TheServiceKeepsItsStatesAroundThePolicy) {
  const PolicyFiles policy = TrotOfGo2();
  WalkingRig rig("go2", Plays("mcf", policy));
  rig.StandUp();
  EXPECT_EQ(rig.state().name, "standing, joints locked");
  EXPECT_EQ(rig.Ask(goal::Move{0.5, 0, 0, 1}), MotionVerdict::kIgnored) << "as without a policy";
  rig.Ask(goal::BalanceStand{});
  rig.Run(2);
  rig.Walk({0.5, 0, 0}, 1);
  ASSERT_EQ(rig.state().name, "walking");
  EXPECT_EQ(rig.Ask(goal::StandUp{}), MotionVerdict::kTaken) << "once it has stopped";
  EXPECT_EQ(rig.state().name, "walking");
  rig.Run(6);
  EXPECT_EQ(rig.state().name, "standing, joints locked");
  rig.Ask(goal::BalanceStand{});
  rig.Run(2);
  rig.Walk({0.5, 0, 0}, 1);
  rig.Ask(goal::Damp{});
  rig.Run(0.1);
  EXPECT_EQ(rig.state().name, "damping");
  EXPECT_EQ(rig.command().motors[0].kp, 0);
}

TEST_F(PolicyMotionTest, ThePolicyStepsAtItsOwnPeriodAndItsTargetsAreThoseComputedByHand) {
  const PolicyFiles policy = TrotOfGo2();
  WalkingRig rig("go2", Plays("mcf", policy));
  rig.Start("standing");
  rig.Run(1);
  while (rig.state().name != "walking") rig.Walk({0.6, 0, 0}, 0.02);
  std::vector<std::pair<double, double>> changes;  // of a thigh's target, with their times
  rig.watch = [&, last = 1e9]() mutable {
    const double q = rig.command().motors[1].q;
    if (q != last) changes.emplace_back(rig.time(), q);
    last = q;
  };
  rig.Walk({0.6, 0, 0}, 1);
  ASSERT_GT(changes.size(), 20U);
  for (std::size_t i = 2; i < changes.size(); ++i) {
    const double periods = (changes[i].first - changes[i - 1].first) / 0.02;
    EXPECT_NEAR(periods, std::round(periods), 1e-6);
  }
  // The network's law, of the phase that moves by 0.05 a step.
  const auto thigh = [](int step) {
    const double angle = 2 * M_PI * 0.05 * step, ahead = 0.6;
    const auto relu = [](double x) { return std::max(x, 0.0); };
    const double swing = relu(std::sin(angle) + ahead - 1) - relu(-std::sin(angle) + ahead - 1);
    return 0.67 - 0.5 * swing + 0.25 * relu(std::cos(angle) + 2 * ahead - 1);
  };
  for (const auto& [time, q] : changes) {
    double nearest = 1;
    for (int step = 0; step < 20; ++step) nearest = std::min(nearest, std::abs(thigh(step) - q));
    EXPECT_LT(nearest, 1e-5) << time;
  }
}

TEST_F(PolicyMotionTest, AG1StandsInAWalkingStateAndObeysMoves) {
  const PolicyFiles policy = StandOfG1();
  HumanoidRig rig(G1With(policy));
  rig.SetDown(501);
  EXPECT_EQ(rig.state().id, 501);
  EXPECT_EQ(rig.state().name, "walking");
  EXPECT_EQ(rig.command().motors[0].kp, 150);
  rig.Run(9);
  EXPECT_TRUE(rig.standing());
  EXPECT_EQ(rig.state().mode, 0);
  EXPECT_EQ(rig.Ask(goal::Move{0, 0, 0.4, 1}), MotionVerdict::kTaken);
  rig.Run(0.9);
  EXPECT_EQ(rig.state().mode, 1) << "moving";
  EXPECT_NEAR(rig.q("waist_yaw_joint"), 0.2, 0.03);
  EXPECT_EQ(rig.SetFsm(4), MotionVerdict::kNotNow) << "while it moves";
  rig.Run(1);
  EXPECT_NEAR(rig.q("waist_yaw_joint"), 0, 0.03) << "the command has expired";
  EXPECT_TRUE(rig.standing());
  EXPECT_EQ(rig.SetFsm(801), MotionVerdict::kTaken);
  EXPECT_EQ(rig.state().id, 801);
  EXPECT_EQ(rig.SetFsm(4), MotionVerdict::kTaken);
  rig.Run(5);
  EXPECT_EQ(rig.state().id, 4);
  EXPECT_TRUE(rig.standing());
  EXPECT_EQ(rig.Ask(goal::Move{0.1, 0, 0, 1}), MotionVerdict::kNotNow);
}

TEST_F(PolicyMotionTest, WithoutAPolicyStatesOfWalkingAreAsBefore) {
  HumanoidRig rig(ConfigOf("g1", {"robot.motion.humanoid.walk=[501, 801]"}));
  rig.Start("standing");
  rig.Run(1.5);
  EXPECT_EQ(rig.SetFsm(801), MotionVerdict::kUnable);
  EXPECT_EQ(rig.SetFsm(501), MotionVerdict::kTaken);
  EXPECT_EQ(rig.state().name, "main control");
  EXPECT_EQ(rig.Ask(goal::Move{0.1, 0, 0, 1}), MotionVerdict::kTaken) << "on the model";
}

TEST_F(PolicyMotionTest, EachMotionServiceHasTheControllerOfItsOwn) {
  QuadrupedRig rig("go2", {"robot.firmware=1.1.5", "motion.service=normal",
                           "robot.services.ai_sport.controller=damping"});
  rig.Start("lying");
  EXPECT_EQ(rig.Ask(goal::StandUp{}), MotionVerdict::kTaken);
  rig.Run(3);
  EXPECT_EQ(rig.state().name, "standing, joints locked");
  rig.Switch("ai");
  rig.Run(1);
  EXPECT_EQ(rig.state().name, "damping");
  EXPECT_NE(rig.Ask(goal::StandUp{}), MotionVerdict::kTaken);
}

TEST_F(PolicyMotionTest, SaysWhatAPolicyLacksBeforeAnythingMoves) {
  const PolicyFiles policy = TrotOfGo2();
  const std::vector<std::string> plays = Plays("mcf", policy);
  EXPECT_EQ(WhyNot("go2", plays), "");
  EXPECT_EQ(WhyNot("go2", {plays[0]}),
            "robot.services.mcf.policy: expected the definition that its controller policy plays");
  EXPECT_THAT(WhyNot("go2", {plays[0], "robot.services.mcf.policy=walk.yaml"}),
              HasSubstr("walk.yaml: expected a policy's definition: no such file"));
  EXPECT_THAT(WhyNot("go2", {"robot.services.mcf.controller=polcy"}),
              HasSubstr("robot.services.0.controller: expected one of default, quadruped, "
                        "humanoid, damping, policy, got 'polcy'; did you mean 'policy'?"));
  EXPECT_THAT(WhyNot("go2", {"robot.services.mcf.controller=humanoid"}),
              HasSubstr("robot.services.0.controller: no controller 'humanoid' for a robot of its "
                        "kind"));
  EXPECT_THAT(WhyNot("go2w", {"robot.services.0.controller=policy"}), HasSubstr("no controller"));
  EXPECT_THAT(WhyNot("g1", Plays("ai_sport", policy)),
              HasSubstr("robot.motion.humanoid.walk: expected the states in which the policy of "
                        "ai_sport walks"));
  policy.Change("step_dt: 0.02", "step_dt: 0.003");
  EXPECT_THAT(WhyNot("go2", plays),
              HasSubstr("deploy.yaml: step_dt: expected a multiple of the period of "
                        "robot.rates.service_hz"));
  policy.Change("step_dt: 0.003", "step_dt: 0.02");
  policy.Change("gait_phase", "gait_fase");
  EXPECT_THAT(WhyNot("go2", plays), HasSubstr("observations.gait_fase: unknown observation; did "
                                              "you mean 'gait_phase'?"));
  policy.Change("gait_fase", "gait_phase");
  policy.Change("velocity_commands", "joint_pos_rel");
  EXPECT_THAT(WhyNot("go2", plays),
              HasSubstr("deploy.safetensors: the network takes 5 numbers; the observations of"));
  std::filesystem::remove(policy.weights());
  EXPECT_THAT(WhyNot("go2", plays), HasSubstr("deploy.safetensors: expected a file of weights"));
}

TEST_F(PolicyMotionTest, ARobotsFileNamesAPolicyThatStandsBesideIt) {
  const PolicyFiles policy = TrotOfGo2();
  const std::filesystem::path layer =
      std::filesystem::path(policy.definition()).parent_path() / "layer.yaml";
  WriteFile(layer, "robot: {services: {mcf: {controller: policy, policy: deploy.yaml}}}\n");
  const config::Config config =
      config::LoadConfig({.robot = "go2", .files = {layer}, .sets = {}}, UNDERSTUDY_SOURCE_DIR);
  EXPECT_EQ(config.robots[0].spec.services[0].policy, policy.definition());
}

TEST_F(PolicyMotionTest, EachControllerIsDocumented) {
  const std::string page = FileText(UNDERSTUDY_SOURCE_DIR "/docs/reference/policies.md");
  for (const ControllerRow& row : Controllers()) {
    EXPECT_THAT(page, HasSubstr("| `" + std::string(row.name) + "` | " + std::string(row.is)));
  }
}

}  // namespace
}  // namespace understudy::motion
