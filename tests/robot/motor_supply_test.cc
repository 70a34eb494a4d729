// Tests what motors take from the bus, and what its voltage and its power leave them.
#include <vector>

#include <gtest/gtest.h>

#include "tests/robot/motor_bank_fixture.h"

namespace understudy::robot {
namespace {

TEST_F(MotorBankTest, LosesTorqueWithTheVoltageOfTheBus) {
  RobotSpec spec = Spec();
  spec.motor_types[0].watt_per_nm2 = 0;  // stays cool
  MotorBank bank(spec, kDt);
  const auto most_at = [&](double voltage) {
    return bank.Step(
        {.command = Torques(5000, 0, 0), .q = q_, .dq = dq_, .supply = {.voltage = voltage}})[0];
  };
  EXPECT_EQ(most_at(50), 1000);
  EXPECT_EQ(most_at(40), 1000);
  EXPECT_FALSE(bank.undervoltage(0));
  EXPECT_EQ(most_at(20), 500);
  EXPECT_TRUE(bank.undervoltage(0));
}

// 10 N·m at 3 rad/s are 30 W of work and 10 W of loss.
TEST_F(MotorBankTest, TakesWorkAndLossesFromTheBus) {
  dq_ = {3, 0, 0};
  Step(&bank_, Torques(10, 0, 0));
  EXPECT_NEAR(bank_.power(), 40, 1e-9);
  Step(&bank_, Torques(-10, 0, 0));
  EXPECT_NEAR(bank_.power(), -20, 1e-9);
}

TEST_F(MotorBankTest, TakesNoMorePowerThanThereIs) {
  dq_ = {3, 0, 0};
  for (const double most : {30.0, 1.0, 0.0}) {
    const auto tau = bank_.Step(
        {.command = Torques(10, 4, 0), .q = q_, .dq = dq_, .supply = {.most_power = most}});
    EXPECT_NEAR(bank_.power(), most, 1e-9);
    EXPECT_NEAR(tau[1], 0.4 * tau[0], 1e-12);
    EXPECT_NEAR(3 * tau[0] + 0.1 * (tau[0] * tau[0] + tau[1] * tau[1] / 2), most, 1e-9);
  }
}

TEST_F(MotorBankTest, WarmsByTheCurrentThatItsShareOfThePowerLeavesIt) {
  const auto winding_with = [&](double most) {
    MotorBank bank(spec_, kDt);
    for (int i = 0; i < 200; ++i) {
      bank.Step({.command = Torques(20, 0, 0), .q = q_, .dq = dq_, .supply = {.most_power = most}});
    }
    return bank.winding_c()[0] - 25;
  };
  EXPECT_NEAR(winding_with(10) / winding_with(1000), 0.25, 0.01);
}

TEST_F(MotorBankTest, GivesNothingOnceTheBusIsOff) {
  const RobotSpec spec = [] {
    RobotSpec ideal = Spec();
    for (MotorSpec& motor : ideal.motors) motor.type = "";
    return ideal;
  }();
  MotorBank bank(spec, kDt);
  const auto tau =
      bank.Step({.command = Torques(1, 2, 3), .q = q_, .dq = dq_, .supply = {.on = false}});
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{0, 0, 0}));
  EXPECT_TRUE(bank.undervoltage(0));
}

}  // namespace
}  // namespace understudy::robot
