#include "emulator/hand.h"

#include <array>

#include <gtest/gtest.h>

namespace understudy::emulator {
namespace {

class HandTest : public testing::Test {
 protected:
  robot::HandReading Sample(std::span<const double> q, std::span<const double> dq) {
    robot::HandReading reading;
    hand_.Sample(gate_, q, dq, &reading);
    return reading;
  }

  const robot::HandSpec spec_{
      .name = "left",
      .motors = {{.joint = "thumb", .torque_limit = 2}, {.joint = "index", .torque_limit = 3}},
      .timeout = 1,
      .lock_kd = 0.5,
      .temperature_c = 41};
  std::span<const double> Step(double t) { return hand_.Step(gate_.Current(t), q_, dq_); }

  authority::HandGate gate_{spec_};
  Hand hand_{spec_};
  const std::array<double, 2> q_{0.25, -0.5};
  const std::array<double, 2> dq_{1, -2};
};

TEST_F(HandTest, BrakesBeforeTheFirstCommand) {
  const auto tau = Step(0);
  ASSERT_EQ(tau.size(), 2U);
  EXPECT_EQ(tau[0], -0.5);
  EXPECT_EQ(tau[1], 1);
}

TEST_F(HandTest, ObeysTheMotorLawWithinTheMotorsTorque) {
  gate_.Offer({.motors = {{.enabled = true, .q = 1.25, .dq = 1, .kp = 1, .kd = 9},
                          {.enabled = true, .tau = -30}}},
              0);
  const auto tau = Step(0);
  EXPECT_EQ(tau[0], 1);
  EXPECT_EQ(tau[1], -3);
}

TEST_F(HandTest, TellsAnglesRatesAndTheTorqueThatActs) {
  gate_.Offer({.motors = {{.enabled = true, .tau = 1}, {}}}, 0);
  Step(0);
  const robot::HandReading reading = Sample(q_, dq_);
  ASSERT_EQ(reading.motors.size(), 2U);
  EXPECT_TRUE(reading.motors[0].enabled);
  EXPECT_EQ(reading.motors[0].q, 0.25);
  EXPECT_EQ(reading.motors[0].dq, 1);
  EXPECT_EQ(reading.motors[0].tau, 1);
  EXPECT_EQ(reading.motors[0].casing_c, 41);
  EXPECT_FALSE(reading.motors[1].enabled);
  EXPECT_EQ(reading.motors[1].tau, 1);
  EXPECT_EQ(reading.timed_out[0], 0);
}

TEST_F(HandTest, TellsThatAMotorHasTimedOut) {
  gate_.Offer({.motors = {{.enabled = true, .watched = true}, {}}}, 0);
  Step(1.5);
  const robot::HandReading reading = Sample(q_, dq_);
  EXPECT_EQ(reading.timed_out[0], 1);
  EXPECT_FALSE(reading.motors[0].enabled);
  EXPECT_EQ(reading.timed_out[1], 0);
}

}  // namespace
}  // namespace understudy::emulator
