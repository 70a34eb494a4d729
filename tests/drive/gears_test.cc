#include "drive/gears.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace understudy::drive {
namespace {

constexpr double kDt = 0.001;
constexpr double kArmature = 0.01;

// One motor at a joint that stands at q.
class GearsTest : public testing::Test {
 protected:
  void Make(double backlash, double ripple = 0, double periods = 100) {
    spec_.dynamics.backlash = backlash;
    spec_.dynamics.ripple = ripple;
    spec_.dynamics.ripple_periods = periods;
    gears_ = Gears(spec_, std::vector{kArmature}, kDt);
  }
  double Push(double torque, double q = 0) {
    return gears_.Step(std::vector{torque}, std::vector{q})[0];
  }
  // By how much the shaft is ahead of the joint.
  double Ahead() {
    gears_.AddPlay(std::vector{0.0}, std::vector{0.0});
    return gears_.q()[0];
  }

  robot::RobotSpec spec_;
  Gears gears_{spec_, std::vector{kArmature}, kDt};
};

TEST_F(GearsTest, AreIdealUnlessToldOtherwise) {
  EXPECT_TRUE(gears_.ideal());
  EXPECT_EQ(Push(3), 3);
  EXPECT_EQ(Ahead(), 0);
  Make(0.01);
  EXPECT_FALSE(gears_.ideal());
  Make(0, 0.1);
  EXPECT_FALSE(gears_.ideal());
}

TEST_F(GearsTest, PassNoTorqueOnBeforeThePlayIsCrossedAndAllOfItAfter) {
  Make(0.01);
  int steps = 0;
  double momentum = 0;
  while (Ahead() < 0.005 && steps < 1000) {
    momentum += Push(1) * kDt;
    ++steps;
  }
  // 5 mrad at 100 rad/s²: 10 ms.
  EXPECT_NEAR(steps, 10, 1);
  EXPECT_NEAR(momentum, 1 * steps * kDt, 1e-9);  // none is lost
  EXPECT_EQ(Ahead(), 0.005);
  EXPECT_EQ(Push(1), 1);
  EXPECT_EQ(Ahead(), 0.005);
}

TEST_F(GearsTest, CrossTheWholePlayWhenTheTorqueTurnsRound) {
  Make(0.01);
  for (int i = 0; i < 100; ++i) Push(1);
  EXPECT_EQ(Push(-1), 0);
  EXPECT_LT(Ahead(), 0.005);
  for (int i = 0; i < 100; ++i) Push(-1);
  EXPECT_EQ(Ahead(), -0.005);
  EXPECT_EQ(Push(-1), -1);
}

TEST_F(GearsTest, TellTheShaftsRateWhileItCrosses) {
  Make(0.1);
  Push(1);
  gears_.AddPlay(std::vector{2.0}, std::vector{3.0});
  EXPECT_DOUBLE_EQ(gears_.dq()[0], 3 + 1 / kArmature * kDt);
  EXPECT_DOUBLE_EQ(gears_.q()[0], 2 + 1 / kArmature * kDt * kDt);
}

TEST_F(GearsTest, StartAnewInTheMiddle) {
  Make(0.01);
  for (int i = 0; i < 100; ++i) Push(1);
  gears_.Restart();
  EXPECT_EQ(Ahead(), 0);
  gears_.AddPlay(std::vector{0.0}, std::vector{0.0});
  EXPECT_EQ(gears_.dq()[0], 0);
}

TEST_F(GearsTest, RippleByTheirShareSoManyTimesInATurn) {
  Make(0, 0.1, 50);
  double most = 0, sum = 0;
  int crossings = 0;
  double before = 0;
  constexpr int kPlaces = 10000;
  for (int i = 0; i < kPlaces; ++i) {
    const double swing = Push(2, 2 * std::numbers::pi * (i + 0.5) / kPlaces) - 2;
    most = std::max(most, std::abs(swing));
    crossings += before * swing < 0 ? 1 : 0;
    sum += swing;
    before = swing;
  }
  EXPECT_NEAR(most, 0.2, 1e-3);
  EXPECT_NEAR(sum / kPlaces, 0, 1e-6);
  EXPECT_EQ(crossings, 2 * 50 - 1);
}

}  // namespace
}  // namespace understudy::drive
