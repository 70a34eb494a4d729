// The power switch alone, without a robot.
#include "robot/power.h"

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

constexpr BootSpec kBoot{.states = 2, .services = 3, .motion = 5};

TEST(PowerSwitchTest, IsOnAndBootedUnlessItIsSwitched) {
  Power power(kBoot);
  EXPECT_EQ(power.state(), PowerState::kOn);
  EXPECT_TRUE(power.computes());
  EXPECT_TRUE(power.answers(9, 10));
  EXPECT_FALSE(power.Step(100));
  EXPECT_EQ(power.since(), 0);
}

TEST(PowerSwitchTest, DoesNothingWhileItIsOff) {
  Power power(kBoot);
  power.SwitchOff();
  EXPECT_FALSE(power.Step(100));
  EXPECT_EQ(power.state(), PowerState::kOff);
  EXPECT_FALSE(power.computes());
  EXPECT_FALSE(power.answers(0, 10));
}

TEST(PowerSwitchTest, ComputesFromItsTimeOnAndStartsTheMotionServiceOnce) {
  Power power(kBoot);
  power.SwitchOff();
  power.SwitchOn(10);
  EXPECT_EQ(power.since(), 10);
  EXPECT_EQ(power.state(), PowerState::kBooting);
  EXPECT_EQ(power.boots_for(), 5);
  EXPECT_FALSE(power.Step(11.99));
  EXPECT_FALSE(power.computes());
  EXPECT_FALSE(power.Step(12));
  EXPECT_TRUE(power.computes());
  EXPECT_FALSE(power.Step(14.5));
  EXPECT_EQ(power.state(), PowerState::kBooting);
  EXPECT_EQ(power.boots_for(), 0.5);
  EXPECT_TRUE(power.Step(15));
  EXPECT_EQ(power.state(), PowerState::kOn);
  EXPECT_FALSE(power.Step(16));
}

TEST(PowerSwitchTest, HasItsServicesComeUpOneAfterTheOther) {
  Power power(kBoot);
  power.SwitchOff();
  power.SwitchOn(0);
  power.Step(2.99);
  EXPECT_FALSE(power.answers(0, 4));
  power.Step(3);
  EXPECT_TRUE(power.answers(0, 4));
  EXPECT_FALSE(power.answers(1, 4));
  power.Step(3.5);
  EXPECT_TRUE(power.answers(1, 4));
  EXPECT_FALSE(power.answers(2, 4));
  power.Step(4.5);
  EXPECT_TRUE(power.answers(3, 4));
  power.Step(5);
  EXPECT_TRUE(power.answers(0, 0));  // of no services there is none to wait for
}

TEST(PowerSwitchTest, BootsOnlyWhereItWasOff) {
  Power power(kBoot);
  power.SwitchOn(7);
  EXPECT_EQ(power.state(), PowerState::kOn);
  EXPECT_EQ(power.since(), 0);
  power.SwitchOff();
  power.SwitchOn(8);
  power.SwitchOn(9);  // while it boots
  EXPECT_EQ(power.since(), 8);
}

TEST(PowerSwitchTest, CanSkipTheBootAndBeSwitchedOffInIt) {
  Power power(kBoot);
  power.SwitchOff();
  power.SwitchOn(1);
  power.Skip();
  EXPECT_EQ(power.state(), PowerState::kOn);
  EXPECT_FALSE(power.Step(9));
  power.SwitchOff();
  power.SwitchOn(10);
  power.SwitchOff();
  EXPECT_FALSE(power.Step(20));
  EXPECT_EQ(power.state(), PowerState::kOff);
}

}  // namespace
}  // namespace understudy::robot
