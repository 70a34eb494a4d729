// Checks that every key of robot.motion.quadruped has an effect.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

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

TEST(QuadrupedSettingsTest, StandsUp) {
  MotionRig b2(ConfigOf("b2", {"robot.motion.quadruped.stands_up=true"}));
  EXPECT_TRUE(b2.RunUntil(1002, 0.1));
  MotionRig go2(ConfigOf("go2", {"robot.motion.quadruped.stands_up=false", "start.pose=lying"}));
  go2.Run(0.1);
  EXPECT_EQ(go2.state().id, 1001);
}

TEST(QuadrupedSettingsTest, GesturesFromLock) {
  for (const authority::MotionGoal& action :
       {authority::MotionGoal(goal::Gesture{}), authority::MotionGoal(goal::Sit{}),
        authority::MotionGoal(goal::Pose{})}) {
    QuadrupedRig rig = Rig("gestures_from_lock=false"), usual("go2");
    rig.StandUp();
    EXPECT_EQ(rig.Ask(action), authority::MotionVerdict::kNotNow);
    usual.StandUp();
    EXPECT_EQ(usual.Ask(action), authority::MotionVerdict::kTaken);
    const int wanted = std::holds_alternative<goal::Gesture>(action) ? kGesture
                       : std::holds_alternative<goal::Sit>(action)   ? kSit
                                                                     : kPose;
    EXPECT_TRUE(usual.RunUntil(wanted, 1));
    usual.Run(2);
    EXPECT_LT(usual.tilt(), 0.8);
    EXPECT_GT(usual.height(), 0.15);
  }
}

// A course's program (Dylan-vrl/com304-go2): StandUp, Sit, StandUp, a second apart.
TEST(QuadrupedSettingsTest, StandsUpOutOfSitWhereGesturesAreTakenFromLock) {
  for (const double sits : {1.0, 3.0}) {  // s: on the way, and there
    QuadrupedRig rig = Rig("gestures_from_lock=false"), usual("go2");
    for (QuadrupedRig* one : {&usual, &rig}) {
      one->BalanceStand();
      ASSERT_EQ(one->Ask(goal::Sit{}), authority::MotionVerdict::kTaken);
      one->Run(sits);
    }
    EXPECT_EQ(rig.Ask(goal::StandUp{}), authority::MotionVerdict::kNotNow);
    EXPECT_EQ(usual.Ask(goal::StandUp{}), authority::MotionVerdict::kTaken);
    EXPECT_TRUE(usual.RunUntil(kLocked, 5));
    usual.Run(2);
    EXPECT_EQ(usual.state().id, kLocked);
    EXPECT_NEAR(usual.height(), 0.33, 0.02);
    EXPECT_LT(usual.tilt(), 0.05);
  }
}

TEST(QuadrupedSettingsTest, Charge) {
  QuadrupedRig rig("go2", {"robot.battery.start_soc=0.19"});
  rig.Start("standing");
  rig.Run(1.5);
  EXPECT_EQ(rig.spec().motion.protection.charge.limit, 0.2) << "a Go2's";
  for (const authority::MotionGoal& action :
       {authority::MotionGoal(goal::Move{0.3, 0, 0, 1}), authority::MotionGoal(goal::Gesture{}),
        authority::MotionGoal(goal::StandUp{}), authority::MotionGoal(goal::StandDown{}),
        authority::MotionGoal(goal::BalanceStand{})}) {
    EXPECT_EQ(rig.Ask(action), authority::MotionVerdict::kNotNow);
  }
  EXPECT_EQ(rig.Ask(goal::StopMove{}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(rig.Ask(goal::RecoveryStand{}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(rig.Ask(goal::SpeedLevel{1}), authority::MotionVerdict::kTaken);
  EXPECT_EQ(rig.Ask(goal::Damp{}), authority::MotionVerdict::kTaken);
  QuadrupedRig fuller("go2", {"robot.battery.start_soc=0.21"});
  fuller.Start("standing");
  fuller.Run(0.5);
  EXPECT_EQ(fuller.Ask(goal::Move{0.3, 0, 0, 1}), authority::MotionVerdict::kTaken);
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

// What a Go2 does that is told to go ahead with 0.5 m/s.
struct Walk {
  double strides = 0;  // of the front right foot, 1/s
  double stands = 0;   // part of the time that it does
  double raise = 0;    // m that it is lifted by
  double speed = 0;    // m/s at the end, ahead
  double begun = -1;   // s until it moves with 0.02 m/s
  double at_half = 0;  // m/s, 0.5 s after it was asked
};

Walk Watch(const std::vector<std::string>& settings, const Eigen::Vector3d& wish = {0.5, 0, 0}) {
  std::vector<std::string> keys;
  for (const std::string& setting : settings) {
    keys.push_back("robot.motion.quadruped.walk." + setting);
  }
  QuadrupedRig rig("go2", keys);
  rig.BalanceStand();
  const int foot =
      mj_name2id(&rig.world().model(), mjOBJ_GEOM, rig.spec().feet[0].geoms[0].c_str());
  const double low = rig.world().data().geom_xpos[3 * foot + 2];
  Walk walk;
  double t = 0, from = 0;
  bool up = false;
  rig.watch = [&] {
    t += 0.001;
    const double lifted = rig.world().data().geom_xpos[3 * foot + 2] - low;
    const double speed = rig.world().robot().base().v_WB_W.head<2>().norm();
    if (walk.begun < 0 && speed > 0.02) walk.begun = t;
    if (std::abs(t - 0.5) < 5e-4) walk.at_half = speed;
    if (t < 2) return;
    walk.raise = std::max(walk.raise, lifted);
    walk.stands += (lifted < 0.01) / 4e3;
    walk.strides += (lifted > 0.02 && !up) / 4.0;
    up = lifted > (up ? 0.01 : 0.02);
  };
  for (int i = 0; i < 12; ++i) {
    if (i == 4) from = rig.world().robot().base().p_WB.head<2>().norm();
    rig.Ask(goal::Move{wish.x(), wish.y(), wish.z(), 1});
    rig.Run(0.5);
  }
  walk.speed = (rig.world().robot().base().p_WB.head<2>().norm() - from) / 4;
  return walk;
}

TEST(QuadrupedSettingsTest, WalkPeriodAndDuty) {
  const Walk walk = Watch({"period=[0.4,0.4]", "duty=[0.7,0.7]"});
  EXPECT_NEAR(walk.strides, 1 / 0.4, 0.3);
  EXPECT_NEAR(walk.stands, 0.7, 0.12);
  EXPECT_NEAR(Watch({"period=[0.6,0.6]"}).strides, 1 / 0.6, 0.3);
}

TEST(QuadrupedSettingsTest, WalkFootRaise) {
  EXPECT_NEAR(Watch({"foot_raise=0.05"}).raise, 0.05, 0.015);
  EXPECT_NEAR(Watch({"foot_raise=0.11"}).raise, 0.11, 0.015);
}

TEST(QuadrupedSettingsTest, WalkFriction) {
  EXPECT_LT(Watch({"friction=0.05"}).at_half, 0.7 * Watch({}).at_half) << "dares to push less";
}

TEST(QuadrupedSettingsTest, WalkSpeeds) {
  EXPECT_NEAR(Watch({"most_speed=[0.3,0.4,1]"}).speed, 0.92 * 0.3, 0.03);
  EXPECT_NEAR(Watch({"least_speed=[-0.3,-0.4,-1]"}, {-1, 0, 0}).speed, 0.92 * 0.3, 0.03);
}

TEST(QuadrupedSettingsTest, WalkMostSpeedMayBeNothing) {
  EXPECT_NEAR(Watch({"most_speed=[0,0.4,1]"}, {0.5, 0.3, 0}).speed, 0.92 * 0.3, 0.03);
}

TEST(QuadrupedSettingsTest, WalkDeadBand) {
  EXPECT_LT(Watch({"dead_band=[0.6,0.1,0.1]"}).speed, 0.01);
}

TEST(QuadrupedSettingsTest, WalkGain) { EXPECT_NEAR(Watch({"gain=[0.6,1,1]"}).speed, 0.3, 0.03); }

TEST(QuadrupedSettingsTest, WalkTimeConstantAndDeadTime) {
  const Walk usual = Watch({});
  EXPECT_LT(Watch({"time_constant=[1.5,1,1]"}).at_half, 0.6 * usual.at_half);
  EXPECT_GT(Watch({"dead_time=0.25"}).begun, usual.begun + 0.15);
}

TEST(QuadrupedSettingsTest, RefusesAHeightRangeUpsideDown) {
  EXPECT_THROW(Rig("height_range=[0.1,-0.1]"), ConfigError);
}

}  // namespace
}  // namespace understudy::motion
