#include "robot/damage.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/fixture_robot.h"

namespace understudy::robot {
namespace {

class DamageSheetTest : public testing::Test {
 protected:
  static RobotSpec WithTwoMotors() {
    RobotSpec spec = test::FixtureRobot();
    spec.motors.resize(2);
    for (MotorSpec& motor : spec.motors) motor.torque_limit = 10;
    spec.motors[0].no_load_speed = 20;
    spec.motors[1].no_load_speed = 0;  // not known
    return spec;
  }

  void Step(double seconds = 1) {
    sheet_.Step({.command = command_,
                 .q = q_,
                 .dq = dq_,
                 .torque = torque_,
                 .winding_c = winding_c_,
                 .battery = battery_,
                 .f_WI_I = f_,
                 .tilt = tilt_},
                seconds);
  }
  void Command(double q) { command_.motors[0] = {.enabled = true, .q = q, .kp = 50}; }
  const MotorDamage& motor() const { return sheet_.damage().motors[0]; }
  const MotorDamage& other() const { return sheet_.damage().motors[1]; }

  RobotSpec spec_ = WithTwoMotors();
  RobotCommand command_{.motors = std::vector<MotorCommand>(2)};
  std::vector<double> q_{0, 0}, dq_{0, 0}, torque_{0, 0}, winding_c_{30, 30};
  BatteryReading battery_{.voltage = 50, .current = -2};
  Eigen::Vector3d f_{0, 0, 9.81};
  double tilt_ = 0;
  DamageSheet sheet_{spec_, {{-1, 1}, {-std::numeric_limits<double>::infinity(), 1}}};
};

TEST_F(DamageSheetTest, CountsTheTimeAtTheTorqueLimitEitherWay) {
  torque_[0] = 9.81;
  Step(0.5);
  torque_[0] = -10;
  Step(0.25);
  torque_[0] = 9.79;
  Step();
  EXPECT_EQ(motor().at_torque_limit, 0.75);
  EXPECT_EQ(other().at_torque_limit, 0);
}

TEST_F(DamageSheetTest, CountsTheTimeAtTheSpeedLimitWhereOneIsKnown) {
  dq_ = {-20, 20};
  Step(0.5);
  dq_ = {19, 20};
  Step(0.5);
  EXPECT_EQ(motor().at_speed_limit, 0.5);
  EXPECT_EQ(other().at_speed_limit, 0);
}

TEST_F(DamageSheetTest, KeepsTheHottestWindingAndTheTimeThatItWasTooHot) {
  winding_c_[0] = spec_.thermal.trip_c;
  Step(2);
  winding_c_[0] = 60;
  Step(2);
  EXPECT_EQ(motor().hottest_c, spec_.thermal.trip_c);
  EXPECT_EQ(motor().tripped, 2);
}

TEST_F(DamageSheetTest, KeepsTheSpeedAtWhichAJointCameToItsEnd) {
  dq_[0] = 3;
  q_[0] = 0.99;
  Step();
  EXPECT_EQ(motor().hardest_stop, 0);
  q_[0] = 1.01;
  Step();
  dq_[0] = 8;  // while it is there, it does not come to it
  Step();
  EXPECT_EQ(motor().hardest_stop, 3);
}

TEST_F(DamageSheetTest, KnowsNoEndWhereThereIsNoRange) {
  dq_[1] = -30;
  q_[1] = -100;
  Step();
  Step();
  EXPECT_EQ(other().hardest_stop, 0);
}

TEST_F(DamageSheetTest, MeasuresTheFirstCommandFromTheJointAndOthersFromTheLast) {
  Step();
  q_[0] = 0.2;
  Command(0.5);
  Step();
  EXPECT_DOUBLE_EQ(motor().largest_jump, 0.3);
  Command(0.6);
  Step();
  EXPECT_DOUBLE_EQ(motor().largest_jump, 0.3);
  Command(-0.4);
  Step();
  EXPECT_DOUBLE_EQ(motor().largest_jump, 1);
}

TEST_F(DamageSheetTest, TakesNoJumpFromCommandsThatHoldNoAngle) {
  Step();
  command_.motors[0] = {.enabled = true, .q = 5, .kd = 3};
  Step();
  command_.motors[0] = {.enabled = true, .q = kNoPosition, .kp = 50};
  Step();
  command_.motors[0] = {.q = 5, .kp = 50};
  Step();
  EXPECT_EQ(motor().largest_jump, 0);
}

TEST_F(DamageSheetTest, TakesBeingPutElsewhereForNoJumpNorStop) {
  Command(0.5);
  Step();
  sheet_.Restart();
  Command(-0.5);
  q_[0] = 1.01;
  dq_[0] = 4;
  Step();
  EXPECT_EQ(motor().largest_jump, 0);
  EXPECT_EQ(motor().hardest_stop, 0);
}

TEST_F(DamageSheetTest, AddsUpWhatThePackGaveAndKeepsItsPeak) {
  Step(2);
  battery_.current = -30;
  Step(1);
  battery_.current = 5;  // charged by braking: nothing is given
  Step(1);
  EXPECT_EQ(sheet_.damage().energy, 2 * 50 * 2 + 30 * 50);
  EXPECT_EQ(sheet_.damage().peak_current, 30);
  EXPECT_EQ(sheet_.damage().time, 4);
}

TEST_F(DamageSheetTest, CountsAFallOnceUntilItIsUpAgain) {
  for (const double tilt : {0.2, 1.1, 0.8, 1.3, 0.4, 1.2}) {
    tilt_ = tilt;
    Step();
  }
  EXPECT_EQ(sheet_.damage().falls, 2);
  EXPECT_EQ(sheet_.damage().worst_tilt, 1.3);
}

TEST_F(DamageSheetTest, CountsAnotherFallOfARobotThatWasPutUpInBetween) {
  tilt_ = 1.2;
  Step();
  sheet_.Restart();
  Step();
  EXPECT_EQ(sheet_.damage().falls, 2);
}

TEST_F(DamageSheetTest, KeepsTheHardestShock) {
  f_ = {30, 0, -40};
  Step();
  f_ = {0, 0, 9.81};
  Step();
  EXPECT_EQ(sheet_.damage().shock, 50);
}

TEST(DamageLimitsTest, AreOfEveryFigureWithUnitAndSource) {
  RobotSpec spec = test::FixtureRobot();
  spec.battery = {.cells = 10, .capacity_ah = 2, .cutoff_a = 60};
  spec.battery.cell_v.fill(4);
  spec.imu.accel_step = 0.001;
  std::map<std::string, DamageLimit> limits;
  for (const DamageLimit& one : DamageLimitsOf(spec)) limits[one.figure] = one;
  EXPECT_EQ(limits.size(), 11U);
  EXPECT_EQ(limits["energy"].limit, 2 * 3600 * 10 * 4);
  EXPECT_EQ(limits["peak_current"].limit, 60);
  EXPECT_EQ(limits["shock"].limit, 32.768);
  EXPECT_EQ(limits["worst_tilt"].limit, 1);
  EXPECT_EQ(limits["falls"].limit, 0);
  EXPECT_EQ(limits["tripped"].limit, spec.thermal.trip_c);
  EXPECT_EQ(limits["hottest"].limit, spec.thermal.derate_c);
  EXPECT_EQ(limits["hardest_stop"].limit, 1);
  for (const char* own : {"at_torque_limit", "at_speed_limit", "largest_jump"}) {
    EXPECT_TRUE(std::isnan(limits[own].limit)) << own;
  }
  for (const auto& [figure, one] : limits) {
    EXPECT_EQ(one.unit.empty(), figure == "falls") << figure;
    EXPECT_NE(one.source.find(": "), std::string::npos) << figure;
  }
}

TEST(DamageLimitsTest, AreNoneWhereTheRobotsFileHasNone) {
  RobotSpec spec = test::FixtureRobot();
  spec.battery = {};
  spec.imu.accel_step = 0;
  for (const DamageLimit& one : DamageLimitsOf(spec)) {
    if (one.figure == "energy" || one.figure == "peak_current" || one.figure == "shock") {
      EXPECT_TRUE(std::isnan(one.limit)) << one.figure;
    }
  }
}

TEST(DamageLimitsTest, OfAJumpIsWhatTakesAllOfTheTorqueWithTheGainThatHolds) {
  RobotSpec spec = test::FixtureRobot();
  spec.motors[0].torque_limit = 24;
  spec.motors[0].no_load_speed = 30;
  spec.motors[0].hold_kp = 60;
  spec.motors[1].hold_kp = 0;
  const std::vector<MotorLimits> limits = MotorLimitsOf(spec);
  EXPECT_EQ(limits[0].torque, 24);
  EXPECT_EQ(limits[0].speed, 30);
  EXPECT_EQ(limits[0].jump, 0.4);
  EXPECT_EQ(limits[1].jump, 0);
}

}  // namespace
}  // namespace understudy::robot
