// Humanoids walk as they are commanded, on their own sensors, with noise and 5 ms of delay.

#include "motion/humanoid/walk.h"

#include <array>
#include <cmath>
#include <random>

#include "tests/motion/humanoid/fixture.h"

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

// On its feet in the usual walking state.
class Walker : public HumanoidRig {
 public:
  explicit Walker(const std::string& robot, std::vector<std::string> settings = {}, int seed = 1)
      : HumanoidRig(ConfigOf(robot, Joined(std::move(settings), seed))) {
    Start("standing");
    Run(1.5);
    EXPECT_EQ(SetFsm(spec().motion.humanoid.balance.front()), Verdict::kTaken);
    Run(1);
  }

  bool Walk(const Vector3d& velocity, double seconds) {
    Ask(goal::Move{velocity.x(), velocity.y(), velocity.z(), seconds});
    return Run(seconds) && standing();
  }

  // N·s per kg at the torso, ahead and left, within 0.1 s.
  void PushBy(const Vector3d& push) {
    constexpr double kTime = 0.1;  // s
    const double mass = world().robot().weight() / 9.81;
    Push(Eigen::AngleAxisd(rpy().z(), Vector3d::UnitZ()) * push * mass / kTime, kTime);
  }

  // m/s ahead and left, rad/s: the truth's mean over `seconds` of that command, after 3 s of it.
  Vector3d Mean(const Vector3d& wish, double seconds) {
    Walk(wish, 3);
    Vector3d mean{0, 0, 0};
    constexpr double kPart = 0.02;
    double yaw = rpy().z();
    for (double t = 0; t < seconds; t += kPart) {
      Ask(goal::Move{wish.x(), wish.y(), wish.z(), 1});
      Run(kPart);
      const Vector3d v = world().robot().base().v_WB_W;
      mean += Eigen::AngleAxisd(-rpy().z(), Vector3d::UnitZ()) * Vector3d(v.x(), v.y(), 0) * kPart;
      mean.z() += std::remainder(rpy().z() - yaw, 2 * M_PI);
      yaw = rpy().z();
    }
    return mean / seconds;
  }

 private:
  static std::vector<std::string> Joined(std::vector<std::string> settings, int seed) {
    settings.emplace_back("robot.dynamics.delay=0.005");
    settings.emplace_back("sensors.seed=" + std::to_string(seed));
    return settings;
  }
};

class HumanoidWalkTest : public test::MujocoTest {};

TEST_F(HumanoidWalkTest, AG1WalksAsFastAsItIsCommanded) {
  Walker g1("g1");
  for (const Vector3d& wish : {Vector3d{0.6, 0, 0}, Vector3d{-0.3, 0, 0}, Vector3d{0, 0.25, 0},
                               Vector3d{0, -0.25, 0}, Vector3d{0, 0, 0.5}}) {
    const Vector3d mean = g1.Mean(wish, 6);
    ASSERT_TRUE(g1.standing());
    EXPECT_LT((mean - wish).cwiseAbs().maxCoeff(), 0.07)
        << wish.transpose() << ", " << mean.transpose();
  }
}

TEST_F(HumanoidWalkTest, AG1WalksWithEachPairOfItsHands) {
  const std::vector<std::string> makes = ConfigOf("g1").robots[0].spec.hand_makes;
  ASSERT_FALSE(makes.empty());
  for (const std::string& make : makes) {
    Walker g1("g1", {"robot.hand_make=" + make});
    EXPECT_TRUE(g1.Walk({0.3, 0, 0}, 10)) << make;
    EXPECT_GT(g1.world().robot().base().p_WB.x(), 2.4) << make;
  }
}

TEST_F(HumanoidWalkTest, KeepsToTheFiguresOfItsSteps) {
  const std::string steps = "robot.motion.humanoid.steps.";
  Walker slow("g1",
              {steps + "most_speed=[0.2, 0.1, 0.2]", steps + "least_speed=[-0.1, -0.1, -0.1]"});
  EXPECT_NEAR(slow.Mean({0.6, 0, 0}, 4).x(), 0.2, 0.07);
  EXPECT_NEAR(slow.Mean({-0.3, 0, 0}, 4).x(), -0.1, 0.07);
  std::vector<double> ends;  // m
  for (const std::string changed : {"time=0", "time=0.4", "foot_raise=0.05"}) {
    Walker g1("g1", {steps + changed});
    ASSERT_TRUE(g1.Walk({0.4, 0, 0}, 4)) << changed;
    ends.push_back(g1.world().robot().base().p_WB.x());
  }
  EXPECT_NE(ends[1], ends[0]);
  EXPECT_NE(ends[2], ends[0]);
}

TEST_F(HumanoidWalkTest, AG1KeepsOnItsFeetForAMinuteOfMixedCommands) {
  for (const int seed : {1, 2}) {
    Walker g1("g1", {"randomization.mass=[0.9, 1.1]", "randomization.seed=" + std::to_string(seed)},
              seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto draw = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / std::mt19937::max();
    };
    for (int i = 0; i < 20; ++i) {
      const Vector3d wish(draw(-0.3, 0.6), draw(-0.25, 0.25), draw(-0.5, 0.5));
      ASSERT_TRUE(g1.Walk(i % 4 == 3 ? Vector3d(0, 0, 0) : wish, 3)) << seed << " " << i;
    }
    EXPECT_EQ(g1.state().id, 501);
  }
}

TEST_F(HumanoidWalkTest, StandsCalmlyOnceTheCommandHasExpired) {
  Walker g1("g1");
  EXPECT_EQ(g1.state().mode, 0);
  g1.Walk({0.5, 0, 0.3}, 3);
  EXPECT_EQ(g1.state().mode, 1);
  g1.Run(4);
  EXPECT_EQ(g1.state().mode, 0);
  const Vector3d stopped = g1.world().robot().base().p_WB;
  double fastest = 0;
  g1.watch = [&] { fastest = std::max(fastest, g1.fastest()); };
  g1.Run(10);
  EXPECT_LT(fastest, 0.2);
  EXPECT_LT((g1.world().robot().base().p_WB - stopped).norm(), 0.03);
  EXPECT_GT(g1.height(), 0.77) << "it has risen again";
}

TEST_F(HumanoidWalkTest, AStandingRobotStepsWhenItIsPushed) {
  Walker g1("g1");
  const double impulse = 0.3 * g1.world().robot().weight() / 9.81;  // N·s
  bool stepped = false;
  g1.watch = [&] { stepped = stepped || g1.state().mode == 1; };
  g1.Push({impulse / 0.1, 0, 0}, 0.1);
  g1.Run(6);
  EXPECT_TRUE(stepped);
  EXPECT_TRUE(g1.standing());
  EXPECT_EQ(g1.state().mode, 0) << "it stands again";
  EXPECT_EQ(g1.state().id, 501);
}

TEST_F(HumanoidWalkTest, ShiftsItsWeightBeforeItStepsAhead) {
  Walker g1("g1");
  const auto apart = [&] {  // m, aside
    std::array<Vector3d, 2> feet;
    for (std::size_t i = 0; i < feet.size(); ++i) {
      const physics::MujocoWorld& world = g1.world();
      const int geom =
          mj_name2id(&world.model(), mjOBJ_GEOM, g1.spec().feet[i].geoms.front().c_str());
      feet[i] = Vector3d(world.data().geom_xpos + 3 * geom);
    }
    const Vector3d way = feet[0] - feet[1];
    return std::abs((Eigen::AngleAxisd(-g1.rpy().z(), Vector3d::UnitZ()) * way).y());
  };
  const double standing = apart(), impulse = 0.3 * g1.world().robot().weight() / 9.81;  // N·s
  double widest = 0;
  g1.watch = [&] { widest = std::max(widest, apart()); };
  g1.Push({impulse / 0.1, 0, 0}, 0.1);
  g1.Run(3);
  EXPECT_TRUE(g1.standing());
  EXPECT_LT(widest, standing + 0.2) << "standing: " << standing;
}

// N·s per kg, ahead and left: what it is wanted to take.
const std::array kPushes = {Vector3d{0.3, 0, 0}, Vector3d{-0.3, 0, 0}, Vector3d{0, 0.2, 0},
                            Vector3d{0, -0.2, 0}};

TEST_F(HumanoidWalkTest, AWalkingG1TakesPushesFromAnySideInAnyPhase) {
  constexpr double kTwoSteps = 0.72;  // s
  for (const Vector3d& push : kPushes) {
    Walker g1("g1");
    for (const double phase : {0.0, 0.25, 0.5, 0.75}) {
      ASSERT_TRUE(g1.Walk({0.3, 0, 0}, 4 * kTwoSteps + phase * kTwoSteps));
      g1.PushBy(push);
      ASSERT_TRUE(g1.Walk({0.3, 0, 0}, (4 - phase) * kTwoSteps))
          << push.transpose() << ", " << phase;
    }
  }
}

TEST_F(HumanoidWalkTest, KnowsHowFastItGoes) {
  Walker g1("g1");
  double error = 0;
  long ticks = 0;
  const auto compare = [&] {
    error += (g1.state().v_WB_W - g1.world().robot().base().v_WB_W).squaredNorm();
    ++ticks;
  };
  for (const Vector3d& wish :
       {Vector3d{0.5, 0, 0}, Vector3d{0.3, 0.2, 0.4}, Vector3d{-0.3, 0, -0.5}}) {
    g1.Walk(wish, 2);
    g1.watch = compare;
    ASSERT_TRUE(g1.Walk(wish, 4));
  }
  EXPECT_LT(std::sqrt(error / static_cast<double>(ticks)), 0.03) << "m/s";
}

TEST_F(HumanoidWalkTest, StepsOnTheSpotInBalanceModeOne) {
  Walker g1("g1");
  ASSERT_EQ(g1.Ask(goal::SetBalanceMode{1}), Verdict::kTaken);
  g1.Run(5);
  EXPECT_EQ(g1.state().mode, 1);
  EXPECT_LT(g1.world().robot().base().p_WB.head<2>().norm(), 0.15);
  ASSERT_EQ(g1.Ask(goal::SetBalanceMode{0}), Verdict::kTaken);
  g1.Run(3);
  EXPECT_EQ(g1.state().mode, 0);
}

TEST_F(HumanoidWalkTest, WavesWhileItWalks) {
  Walker g1("g1");
  g1.Walk({0.3, 0, 0}, 2);
  ASSERT_EQ(g1.Ask(goal::ArmAction{26}), Verdict::kTaken);
  ASSERT_TRUE(g1.Walk({0.3, 0, 0}, 2));
  EXPECT_LT(g1.q("right_shoulder_pitch_joint"), -2);
  EXPECT_TRUE(g1.Walk({0.3, 0, 0}, 4));
}

TEST_F(HumanoidWalkTest, KeepsStillOnTheCrane) {
  HumanoidRig g1("g1");
  g1.Start("hanging");
  g1.SetFsm(1);
  g1.SetFsm(4);
  g1.Run(5);
  ASSERT_EQ(g1.SetFsm(501), Verdict::kTaken);
  EXPECT_EQ(g1.Ask(goal::Move{0.3, 0, 0, 1}), authority::MotionVerdict::kNotNow);
}

TEST_F(HumanoidWalkTest, WalksTheSameBitForBit) {
  std::array<std::vector<double>, 2> ends;
  for (std::vector<double>& end : ends) {
    Walker g1("g1");
    g1.Walk({0.4, 0.1, 0.2}, 3);
    end.assign(g1.world().robot().q().begin(), g1.world().robot().q().end());
  }
  EXPECT_EQ(ends[0], ends[1]);
}

}  // namespace
}  // namespace understudy::motion
