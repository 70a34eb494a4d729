// How hot robots get by what they do all day, and what they take from their batteries for it.
#include <algorithm>

#include "tests/motion/humanoid/fixture.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

// Motors that are as hot after seconds as others after an hour.
config::Config Hasty(config::Config config) {
  for (robot::MotorTypeSpec& type : config.robots[0].spec.motor_types) {
    type.winding_time = 0.5;
    type.casing_time = 3;
  }
  return config;
}

double Hottest(const MotionRig& rig) {
  double hottest = 0;
  for (const robot::MotorReading& motor : rig.robot().sampled().motors) {
    hottest = std::max(hottest, motor.winding_c);
  }
  return hottest;
}

class HeatTest : public test::MujocoTest, public testing::WithParamInterface<std::string> {};

TEST_P(HeatTest, AnHourOfStandingLeavesAllOfTheTorque) {
  const config::Config config = ConfigOf(GetParam(), {"start.pose=standing"});
  HumanoidRig rig(Hasty(config));
  ASSERT_TRUE(rig.Run(1));
  if (!robot::IsQuadruped(config.robots[0].spec.kind)) {
    rig.SetFsm(config.robots[0].spec.motion.humanoid.balance.front());
  }
  ASSERT_TRUE(rig.Run(19));
  EXPECT_LT(rig.tilt(), 0.1);
  EXPECT_LT(Hottest(rig), config.robots[0].spec.thermal.derate_c - 10);
  EXPECT_GT(Hottest(rig), config.robots[0].spec.thermal.ambient_c +
                              config.robots[0].spec.thermal.rest_rise_c + 1);
  EXPECT_GT(rig.port().last().state.tick_ms, 19'900) << "a pack that cuts off leaves it dark";
}

INSTANTIATE_TEST_SUITE_P(Robots, HeatTest, testing::ValuesIn(test::Robots()),
                         [](const auto& robot) { return robot.param; });

// docs/dev/sources.md#go2-captures: legs at 27 to 51 °C when cool and at 33 to 78 after standing,
// and 3.6 A of the battery.
TEST(Go2HeatTest, StandsAtTheTemperaturesAndTheCurrentThatAreSeen) {
  MotionRig rig(Hasty(ConfigOf("go2", {"start.pose=standing"})));
  ASSERT_TRUE(rig.Run(20));
  for (const robot::MotorReading& motor : rig.robot().sampled().motors) {
    EXPECT_GT(motor.winding_c, 27);
    EXPECT_LT(motor.winding_c, 78);
  }
  EXPECT_NEAR(rig.robot().sampled().battery.current, -3.5, 0.7);
}

TEST(Go2HeatTest, AnHourOfWalkingLeavesAllOfTheTorque) {
  MotionRig rig(Hasty(ConfigOf("go2", {"start.pose=standing"})));
  ASSERT_TRUE(rig.Run(1));
  ASSERT_EQ(rig.Ask(goal::BalanceStand{}), authority::MotionVerdict::kTaken);
  ASSERT_TRUE(rig.Run(1));
  ASSERT_EQ(rig.Ask(goal::Move{1, 0, 0, 60}), authority::MotionVerdict::kTaken);
  ASSERT_TRUE(rig.Run(20));
  EXPECT_GT(rig.world().robot().base().p_WB.x(), 10);
  EXPECT_LT(Hottest(rig), rig.spec().thermal.derate_c);
  EXPECT_GT(Hottest(rig), 60);
}

// It is pulled down by a hand: its motors do all that they can, and the pack gives no more than
// the drives share.
TEST(Go2HeatTest, TakesNoMoreFromItsBatteryThanTheDrivesShare) {
  MotionRig rig(ConfigOf("go2", {"start.pose=standing"}));
  double most = 0;
  rig.watch = [&] { most = std::max(most, rig.robot().damage().peak_current); };
  ASSERT_TRUE(rig.Run(1));
  ASSERT_EQ(rig.Ask(goal::BalanceStand{}), authority::MotionVerdict::kTaken);
  for (const double side : {1.0, -1.0}) {
    ASSERT_TRUE(rig.Push({0, side * 600, -400}, 0.3));
    ASSERT_TRUE(rig.Run(3));
  }
  EXPECT_LE(most, rig.spec().battery.most_a + 1e-6);
  EXPECT_GT(most, 5);
}

}  // namespace
}  // namespace understudy::motion
