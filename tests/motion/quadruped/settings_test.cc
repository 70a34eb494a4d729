// Every key of robot.motion.quadruped makes a difference.

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/motion/quadruped/rig.h"

namespace understudy::motion {
namespace {

QuadrupedRig Rig(const std::string& setting, const std::string& robot = "go2") {
  return QuadrupedRig(robot, {"robot.motion.quadruped." + setting});
}

TEST(QuadrupedSettingsTest, StandHeight) {
  QuadrupedRig rig = Rig("stand_height=0.28");
  rig.BalanceStand();
  EXPECT_NEAR(rig.height(), 0.28, 0.01);
}

TEST(QuadrupedSettingsTest, FootX) {
  QuadrupedRig rig = Rig("foot_x=0.03");
  rig.StandUp();
  QuadrupedRig usual("go2");
  usual.StandUp();
  EXPECT_LT(rig.world().robot().q()[1], usual.world().robot().q()[1] - 0.1) << "thigh";
}

TEST(QuadrupedSettingsTest, HeightRange) {
  QuadrupedRig rig = Rig("height_range=[-0.05,0]");
  rig.BalanceStand();
  rig.Ask(goal::BodyHeight{-0.18});
  rig.Run(2);
  EXPECT_NEAR(rig.height(), 0.28, 0.01);
}

TEST(QuadrupedSettingsTest, EulerRange) {
  QuadrupedRig rig = Rig("euler_range=[0.1,0.75,0.6]");
  rig.BalanceStand();
  rig.Ask(goal::Euler{0.75});
  rig.Run(2);
  EXPECT_NEAR(rig.rpy()[0], 0.1, 0.02);
}

TEST(QuadrupedSettingsTest, Sit) {
  QuadrupedRig rig = Rig("sit=[0,-0.05,-0.3]");
  rig.BalanceStand();
  rig.Ask(goal::Sit{});
  rig.Run(2.5);
  EXPECT_NEAR(rig.rpy()[1], -0.3, 0.03);
}

TEST(QuadrupedSettingsTest, KpKd) {
  QuadrupedRig rig("go2", {"robot.motion.quadruped.kp=60", "robot.motion.quadruped.kd=2"});
  rig.StandUp();
  EXPECT_EQ(rig.command().motors[0].kp, 60);
  EXPECT_EQ(rig.command().motors[0].kd, 2);
}

TEST(QuadrupedSettingsTest, DampingKd) {
  QuadrupedRig rig = Rig("damping_kd=7");
  rig.Start("lying");
  rig.Run(0.01);
  EXPECT_EQ(rig.command().motors[0].kd, 7);
}

TEST(QuadrupedSettingsTest, WheelKpKd) {
  QuadrupedRig rig("go2w",
                   {"robot.motion.quadruped.wheel_kp=30", "robot.motion.quadruped.wheel_kd=4"});
  rig.BalanceStand();
  EXPECT_EQ(rig.command().motors[12].kp, 30);
  EXPECT_EQ(rig.command().motors[12].kd, 4);
}

TEST(QuadrupedSettingsTest, RefusesAHeightRangeUpsideDown) {
  EXPECT_THROW(Rig("height_range=[0.1,-0.1]"), ConfigError);
}

}  // namespace
}  // namespace understudy::motion
