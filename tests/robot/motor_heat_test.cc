// Tests how warm motors get, and what they give when they are too hot.
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "tests/robot/motor_bank_fixture.h"

namespace understudy::robot {
namespace {

TEST_F(MotorBankTest, TripsAMotorThatIsTooHotUntilItHasCooled) {
  std::vector<MotorEffects> faults(3);
  const auto torque_at = [&](double celsius) {
    faults[0].heat_c = celsius - 25;
    for (int i = 0; i < 2; ++i) {  // knows the temperature at the end of a period
      bank_.Step({.command = Torques(1e-3, 0, 0), .q = q_, .dq = dq_, .faults = faults});
    }
    return bank_.Step({.command = Torques(1e-3, 0, 0), .q = q_, .dq = dq_, .faults = faults})[0];
  };
  const double trip = spec_.thermal.trip_c;
  EXPECT_EQ(torque_at(trip - 1), 1e-3);
  EXPECT_EQ(torque_at(trip + 1), 0);
  EXPECT_TRUE(bank_.tripped(0));
  EXPECT_FALSE(bank_.tripped(1));
  EXPECT_EQ(torque_at(trip - 9.5), 0);
  EXPECT_EQ(torque_at(trip - 10.5), 1e-3);
}

TEST_F(MotorBankTest, GivesLessTorqueTheHotterItIsDownToHalfWhereItTrips) {
  RobotSpec spec = Spec();
  spec.thermal.derate_c = 100;
  std::vector<MotorEffects> faults(3);
  const auto most_at = [&](double celsius) {
    MotorBank bank(spec, kDt);
    faults[0].heat_c = celsius - 25;
    for (int i = 0; i < 2; ++i) {
      bank.Step({.command = Torques(0, 0, 0), .q = q_, .dq = dq_, .faults = faults});
    }
    EXPECT_EQ(bank.derated(0), celsius > 100);
    return bank.Step({.command = Torques(5000, 0, 0), .q = q_, .dq = dq_, .faults = faults})[0];
  };
  EXPECT_EQ(most_at(99), 1000);
  EXPECT_NEAR(most_at(110), 750, 1e-6);
  EXPECT_NEAR(most_at(119.99), 500, 1);
}

TEST_F(MotorBankTest, StartsAtItsTemperatureOfRest) {
  for (const double temperature : bank_.winding_c()) EXPECT_EQ(temperature, 25);
}

TEST_F(MotorBankTest, StaysAtItsTemperatureOfRestWhileIdle) {
  Work(&bank_, Torques(0, 0, 0), 1000);
  for (const double temperature : bank_.winding_c()) EXPECT_EQ(temperature, 25);
  for (const double temperature : bank_.casing_c()) EXPECT_EQ(temperature, 25);
}

// The same two masses in small steps: °C of winding and casing over rest after `seconds` of `watt`.
std::array<double, 2> InSmallSteps(double watt, double seconds) {
  const MotorTypeSpec type = Type();
  const double winding_j_per_c = type.winding_time / type.winding_c_per_w;
  const double casing_j_per_c = type.casing_time / type.casing_c_per_w;
  double winding = 0;
  double casing = 0;
  constexpr double kStep = 1e-3;
  for (double t = 0; t < seconds; t += kStep) {
    const double through = (winding - casing) / type.winding_c_per_w;
    winding += (watt * (1 + 0.00393 * winding) - through) * kStep / winding_j_per_c;
    casing += (through - casing / type.casing_c_per_w) * kStep / casing_j_per_c;
  }
  return {winding, casing};
}

// 10 N·m are 10 W.
TEST_F(MotorBankTest, WarmsTheWindingBeforeTheCasing) {
  for (double t = 5; t <= 80; t *= 2) {
    MotorBank bank(spec_, kDt);
    Work(&bank, Torques(-10, 0, 0), t);
    const auto [winding, casing] = InSmallSteps(10, t);
    EXPECT_NEAR(bank.winding_c()[0], 25 + winding, 0.01) << t;
    EXPECT_NEAR(bank.casing_c()[0], 25 + casing, 0.01) << t;
    EXPECT_LT(casing, winding);
  }
  Work(&bank_, Torques(-10, 0, 0), 2000);
  EXPECT_NEAR(bank_.winding_c()[0], Hot(10, 1), 1e-3);
  EXPECT_NEAR(bank_.casing_c()[0], 25 + 0.8 * (Hot(10, 1) - 25), 1e-3);
  EXPECT_EQ(bank_.winding_c()[1], 25);
  EXPECT_EQ(bank_.winding_c()[2], 25);
}

// Whatever the step, the same heat in the same time.
TEST_F(MotorBankTest, IntegratesHeatExactly) {
  MotorBank fine(spec_, 0.001), coarse(spec_, 0.1);
  for (int i = 0; i < 20000; ++i) Step(&fine, Torques(10, 0, 0));
  for (int i = 0; i < 200; ++i) Step(&coarse, Torques(10, 0, 0));
  EXPECT_NEAR(fine.winding_c()[0], coarse.winding_c()[0], 1e-9);
  EXPECT_NEAR(fine.casing_c()[0], coarse.casing_c()[0], 1e-9);
}

TEST_F(MotorBankTest, WarmsByTheTorqueOfTheMotorBeforeTheGear) {
  RobotSpec spec = Spec();
  spec.motors[0].gear = 2;
  MotorBank bank(spec, kDt);
  Work(&bank, Torques(20, 0, 0), 2000);
  EXPECT_NEAR(bank.winding_c()[0], Hot(10, 1), 1e-3);
}

// Pitch 8 and roll 8 are 6 of A and 2 of B.
TEST_F(MotorBankTest, WarmsTheMotorsOfAPairEachByItsOwnTorque) {
  Work(&bank_, Torques(0, 8, 8), 2000);
  EXPECT_NEAR(bank_.winding_c()[1], Hot(0.4, 1), 1e-3);
  EXPECT_NEAR(bank_.winding_c()[2], Hot(3.6, 1), 1e-3);
}

TEST_F(MotorBankTest, WarmsTheCasingByFriction) {
  const std::vector<double> friction = {5, 0, 0};
  for (int i = 0; i < 40000; ++i) {
    bank_.Step({.command = Torques(0, 0, 0), .q = q_, .dq = dq_, .friction_w = friction});
  }
  EXPECT_NEAR(bank_.casing_c()[0], 29, 1e-3);
  EXPECT_NEAR(bank_.winding_c()[0], 29, 1e-3);
  EXPECT_EQ(bank_.casing_c()[1], 25);
}

TEST_F(MotorBankTest, WarmsAWeakMotorByTheCurrentThatItTakesAndALimpOneNot) {
  std::vector<MotorEffects> faults(3);
  for (const double share : {0.25, 0.0}) {
    MotorBank bank(spec_, kDt);
    faults[0].torque_share = share;
    for (int i = 0; i < 40000; ++i) {
      bank.Step({.command = Torques(10, 0, 0), .q = q_, .dq = dq_, .faults = faults});
    }
    EXPECT_NEAR(bank.winding_c()[0], share > 0 ? Hot(10, 1) : 25, 1e-3);
  }
}

// 80 N·m are 640 W, of which half of the torque leaves a quarter: more than it can give off.
TEST_F(MotorBankTest, AStalledMotorDeratesTripsAndComesBack) {
  RobotSpec spec = Spec();
  spec.motors[0].torque_limit = 80;
  MotorBank bank(spec, kDt);
  double derated = -1, tripped = -1, back = -1;
  for (int i = 0; i < 20000; ++i) {
    const double t = i * kDt;
    const bool was_tripped = bank.tripped(0);
    const double tau = Step(&bank, Torques(500, 0, 0))[0];
    EXPECT_EQ(tau == 0, was_tripped);
    if (derated < 0 && tau < 80) derated = t;
    if (tripped < 0 && bank.tripped(0)) tripped = t;
    if (tripped > 0 && back < 0 && !bank.tripped(0)) back = t;
  }
  EXPECT_GT(derated, 5);
  EXPECT_GT(tripped, derated);
  EXPECT_LT(tripped, 60);
  EXPECT_GT(back, tripped);
}

}  // namespace
}  // namespace understudy::robot
