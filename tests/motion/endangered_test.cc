// Robots under their motion services that are brought into each danger: what the service does, and
// how it is told. Their rules alone: protection_test.cc.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/motion/humanoid/fixture.h"
#include "tests/motion/quadruped/rig.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

using authority::MotionVerdict;

bool HasTold(const MotionRig& rig, const std::string& danger) {
  return std::ranges::any_of(ToldDangers(rig), [&](const std::string& text) {
    return text.starts_with("protection: " + danger);
  });
}

// What the status tells of a danger now.
robot::Protection Does(const MotionRig& rig, robot::Danger danger) {
  return rig.state().dangers[static_cast<std::size_t>(danger)].does;
}

void Fault(MotionRig* rig, const std::string& component, const std::string& fault, double by = -1) {
  nlohmann::json values = {{"component", component}, {"fault", fault}};
  if (by >= 0) values["by"] = by;
  rig->Request("fault", values);
}

TEST(EndangeredRobotTest, AGo2ThatIsThrownOverDampsAndTellsItsTilt) {
  QuadrupedRig rig("go2");
  rig.Start("standing");
  rig.Run(1);
  EXPECT_TRUE(ToldDangers(rig).empty());
  rig.Push({0, 900, 0}, 0.3);
  EXPECT_TRUE(rig.RunUntil(1001, 2));
  EXPECT_TRUE(HasTold(rig, "tilt"));
  EXPECT_GT(rig.tilt(), 1);
}

TEST(EndangeredRobotTest, AG1ThatIsThrownOverDampsAndTellsItsTilt) {
  HumanoidRig rig("g1");
  rig.Start("standing");
  rig.Run(1);
  rig.SetFsm(501);
  rig.Run(1);
  rig.Push({900, 0, 0}, 0.3);
  EXPECT_TRUE(rig.RunUntil(1, 4));
  EXPECT_TRUE(HasTold(rig, "tilt"));
}

// A limit far below the usual one, since no motor turns half as fast again as it can by itself.
TEST(EndangeredRobotTest, AMotorThatTurnsTooFastIsToldAndNothingElse) {
  QuadrupedRig rig("go2", {"robot.motion.protection.overspeed={limit: 0.02}"});
  rig.Start("lying");
  rig.Run(1);
  EXPECT_FALSE(HasTold(rig, "overspeed"));
  rig.Ask(goal::StandUp{});
  rig.Run(5);
  EXPECT_EQ(rig.state().id, 1002);
  EXPECT_TRUE(HasTold(rig, "overspeed"));
  EXPECT_GT(rig.height(), 0.3) << "it stands all the same";
  EXPECT_EQ(Does(rig, robot::Danger::kOverspeed), robot::Protection::kNothing) << "over";
}

TEST(EndangeredRobotTest, AJointThatReadsBeyondItsRangeIsToldAndNothingElse) {
  QuadrupedRig rig("go2");
  rig.Start("lying");
  rig.Run(1);
  EXPECT_FALSE(HasTold(rig, "joint_end"));
  const double least = -2.7227;  // of the calf's range
  const double q = rig.world().robot().q()[2];
  rig.Request("fault", {{"component", "FR_calf_joint.encoder"}, {"fault", "offset"}, {"by", 0.15}});
  EXPECT_NEAR(q, least, 0.05);
  rig.Run(0.5);
  EXPECT_FALSE(HasTold(rig, "joint_end")) << "to the inside";
  rig.Request("fault", {{"component", "FR_calf_joint.encoder"}, {"fault", "offset"}, {"by", -0.2}});
  rig.Run(0.5);
  EXPECT_TRUE(HasTold(rig, "joint_end"));
  EXPECT_EQ(Does(rig, robot::Danger::kJointEnd), robot::Protection::kWarn);
  EXPECT_EQ(rig.Ask(goal::StandUp{}), MotionVerdict::kTaken);
}

TEST(EndangeredRobotTest, AGo2WhoseChargeIsLowStopsAndWalksNoMore) {
  QuadrupedRig rig("go2");
  rig.Start("standing");
  rig.Run(1);
  ASSERT_EQ(rig.Ask(goal::BalanceStand{}), MotionVerdict::kTaken);
  rig.Run(1);
  ASSERT_EQ(rig.Ask(goal::Move{0.5, 0, 0, 60}), MotionVerdict::kTaken);
  rig.Run(2);
  rig.Request("fault", {{"component", "battery"}, {"fault", "empty"}, {"by", 0.19}});
  rig.Run(3);
  EXPECT_TRUE(HasTold(rig, "charge"));
  const double x = rig.world().robot().base().p_WB.x();
  EXPECT_EQ(rig.Ask(goal::Move{0.5, 0, 0, 5}), MotionVerdict::kNotNow);
  rig.Run(2);
  EXPECT_NEAR(rig.world().robot().base().p_WB.x(), x, 0.05);
  EXPECT_EQ(rig.Ask(goal::Damp{}), MotionVerdict::kTaken);
}

// The soft emergency stop, whatever the robot is just doing.
TEST(EndangeredRobotTest, EveryRobotDampsByItsRemote) {
  for (const std::string& name : test::Robots()) {
    SCOPED_TRACE(name);
    MotionRig rig(ConfigOf(name));
    ASSERT_TRUE(rig.Run(1));
    if (robot::IsQuadruped(rig.spec().kind)) {
      rig.Ask(goal::StandUp{});
    } else {
      rig.Ask(goal::SetFsm{1});
      rig.Run(0.1);
      rig.Ask(goal::SetFsm{rig.spec().motion.humanoid.lock_stand});
    }
    ASSERT_TRUE(rig.Run(1));
    const auto stiff = [&] {
      return std::ranges::any_of(rig.command().motors,
                                 [](const robot::MotorCommand& motor) { return motor.kp > 0; });
    };
    EXPECT_TRUE(stiff());
    rig.Request("remote.press", {{"keys", "L2+B"}});
    ASSERT_TRUE(rig.Run(0.2));
    EXPECT_FALSE(stiff());
    for (std::size_t i = 0; i < rig.spec().motors.size(); ++i) {  // of the body
      EXPECT_GT(rig.command().motors[i].kd, 0) << i;
    }
  }
}

TEST(ProtectedRobotTest, LiesDownBeforeAHotMotorTrips) {
  QuadrupedRig rig("go2");
  rig.Start("standing");
  rig.Run(1);
  Fault(&rig, "FR_calf_joint", "hot", 90);
  EXPECT_TRUE(rig.RunUntil(1004, 20));
  EXPECT_EQ(rig.state().name, "lying down");
  rig.Run(5);
  EXPECT_LT(rig.height(), 0.15);
  EXPECT_EQ(rig.Ask(goal::StandUp{}), MotionVerdict::kNotNow);
  const std::vector<std::string> told = ToldDangers(rig);
  ASSERT_EQ(told.size(), 1U) << told.back();
  EXPECT_TRUE(told[0].starts_with("protection: heat 11")) << told[0];
  EXPECT_TRUE(told[0].ends_with(" °C of FR_calf_joint; the robot lies down, if it can")) << told[0];
  Fault(&rig, "all", "none");
  rig.Run(10);  // a thermometer lags
  EXPECT_EQ(ToldDangers(rig).back(), "protection: heat of FR_calf_joint is within its limit again");
  EXPECT_EQ(rig.Ask(goal::StandUp{}), MotionVerdict::kTaken);
}

TEST(ProtectedRobotTest, DampsWhenAMotorFallsSilentOrAnEncoderFails) {
  for (const auto& [component, fault] :
       {std::pair{"FL_thigh_joint", "off"}, std::pair{"FL_thigh_joint.encoder", "off"}}) {
    QuadrupedRig rig("go2");
    rig.Start("standing");
    rig.Run(1);
    Fault(&rig, component, fault);
    rig.Run(0.15);
    EXPECT_NE(rig.state().id, 1001);
    rig.Run(0.15);
    EXPECT_EQ(rig.state().id, 1001);
    EXPECT_EQ(ToldDangers(rig).size(), 1U);
  }
}

TEST(ProtectedRobotTest, StopsWhenTheRemoteThatSteersItIsGone) {
  QuadrupedRig rig("go2");
  rig.Start("standing");
  rig.Run(1);
  rig.Request("remote.sticks", {{"ly", 0.5}, {"for", 60}});
  rig.Run(2);
  EXPECT_EQ(rig.state().name, "walking");
  Fault(&rig, "remote", "off");
  rig.Run(3);
  EXPECT_EQ(rig.state().name, "standing");
  ASSERT_EQ(ToldDangers(rig).size(), 1U);
  EXPECT_EQ(ToldDangers(rig)[0], "protection: remote; the robot stops");
}

TEST(ProtectedRobotTest, AHumanoidIsOnlyWarnedOfAHotWrist) {
  MotionRig rig(ConfigOf("g1"));
  rig.Start("hanging");
  rig.Run(1);
  const robot::MotionState before = rig.state();
  Fault(&rig, "left_wrist_yaw_joint", "hot", 95);
  rig.Run(20);
  EXPECT_EQ(rig.state().id, before.id);
  EXPECT_EQ(ToldDangers(rig).size(), 1U);
}

}  // namespace
}  // namespace understudy::motion
