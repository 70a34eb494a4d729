// Robots under their motion services with the sensors of config/profiles.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/motion/humanoid/fixture.h"
#include "tests/motion/quadruped/rig.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

std::vector<std::string> Settings(const std::string& profile, int seed) {
  return {"profile=" + profile, "sensors.seed=" + std::to_string(seed)};
}

class ProfileTest : public testing::TestWithParam<const char*> {};

TEST_P(ProfileTest, AGo2StandsAndTrotsForTenSeconds) {
  for (const int seed : {1, 2}) {
    WalkingRig rig("go2", Settings(GetParam(), seed));
    rig.BalanceStand();
    EXPECT_LT(rig.tilt(), 0.15) << seed;
    double tilt = 0;
    rig.watch = [&] { tilt = std::max(tilt, rig.tilt()); };
    rig.Walk({0.5, 0, 0}, 2);
    const Eigen::Vector3d speed = rig.Speed({0.5, 0, 0}, 8);
    EXPECT_NEAR(speed.x(), 0.5, 0.15) << seed;
    EXPECT_LT(std::abs(speed.y()), 0.15) << seed;  // a tilted vertical pulls it aside
    rig.Run(1);                                    // a Move lasts a second
    EXPECT_TRUE(rig.ComesToRest(6)) << seed;
    EXPECT_LT(tilt, 0.3) << seed;
  }
}

TEST_P(ProfileTest, AG1StandsBalanced) {
  for (const int seed : {1, 2}) {
    config::Config config = HumanoidConfig("g1", 0.002);
    config.robots[0].sensors = ConfigOf("g1", Settings(GetParam(), seed)).robots[0].sensors;
    HumanoidRig rig(config);
    rig.Start("standing");
    rig.Run(1);
    ASSERT_EQ(rig.SetFsm(rig.spec().motion.humanoid.balance.front()),
              authority::MotionVerdict::kTaken);
    ASSERT_TRUE(rig.Run(15));
    EXPECT_TRUE(rig.standing()) << seed;
    EXPECT_LT(rig.tilt(), 0.2) << seed;
  }
}

// Of every robot under its motion service, as it moves into its start pose.
TEST(IdealProfileTest, TellsTheTruthToTheLastBit) {
  for (const std::string& name : test::Robots()) {
    SCOPED_TRACE(name);
    MotionRig rig(ConfigOf(name, {"profile=ideal", "sensors.quantise=false"}));
    int told = 0;
    rig.watch = [&] {
      const robot::RobotState& state = rig.robot().sampled();
      if (++told % 10 != 0) return;
      ASSERT_EQ(state.truth.q.size(), state.motors.size());
      for (std::size_t i = 0; i < state.motors.size(); ++i) {
        EXPECT_EQ(state.motors[i].q, state.truth.q[i]);
        EXPECT_EQ(state.motors[i].dq, state.truth.dq[i]);
        EXPECT_EQ(state.motors[i].tau, state.truth.tau[i]);
      }
      EXPECT_EQ(state.imu.R_WI.coeffs(), state.truth.imu.R_WI.coeffs());
      EXPECT_EQ(state.imu.w_WI_I, state.truth.imu.w_WI_I);
      EXPECT_EQ(state.imu.f_WI_I, state.truth.imu.f_WI_I);
      EXPECT_EQ(state.secondary_imu.f_WI_I, state.truth.secondary_imu.f_WI_I);
      EXPECT_EQ(state.foot_force, state.truth.foot_force);
      EXPECT_EQ(state.odometry.p_WB, state.base.p_WB);
      EXPECT_EQ(state.odometry.v_WB_W, state.base.v_WB_W);
    };
    ASSERT_TRUE(rig.Run(0.5));
    EXPECT_GE(told, 250);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ProfileTest, testing::Values("ideal", "nominal", "worn", "harsh"));

}  // namespace
}  // namespace understudy::motion
