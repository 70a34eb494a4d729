#include <cmath>

#include <gtest/gtest.h>

#include "robot/motor.h"

namespace understudy::robot {
namespace {

// Three motors; 1 and 2 are the pitch and roll of a parallel joint.
RobotSpec Spec() {
  RobotSpec spec;
  spec.motors.resize(3, MotorSpec{.joint = {}, .torque_limit = 1000});
  spec.parallel = {{.pitch = 1, .roll = 2, .roll_ratio = 2}};
  spec.thermal = {.ambient_c = 20, .rest_rise_c = 5, .rise_per_nm2_c = 0.1, .time_constant = 100};
  return spec;
}

RobotCommand Torques(double first, double second, double third) {
  RobotCommand command;
  for (const double tau : {first, second, third}) {
    command.motors.push_back({.enabled = true, .tau = tau});
  }
  return command;
}

class MotorBankTest : public testing::Test {
 protected:
  const RobotSpec spec_ = Spec();
  MotorBank bank_{spec_};
  std::vector<double> q_ = {0, 0, 0};
  std::vector<double> dq_ = {0, 0, 0};
};

TEST_F(MotorBankTest, GivesNoTorqueBeforeTheFirstStep) {
  EXPECT_EQ(std::vector(bank_.torque().begin(), bank_.torque().end()),
            (std::vector<double>{0, 0, 0}));
}

TEST_F(MotorBankTest, KeepsMotorOrderInPitchRoll) {
  const auto tau = bank_.Step(Torques(1, 2, 3), q_, dq_, 0.001);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(tau.data(), bank_.torque().data());
}

TEST_F(MotorBankTest, CutsEachMotorToItsOwnLimit) {
  RobotSpec spec = Spec();
  spec.motors[0].torque_limit = 5;
  MotorBank bank(spec);
  const auto tau = bank.Step(Torques(9, 9, -9), q_, dq_, 0.001);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{5, 9, -9}));
}

TEST_F(MotorBankTest, GivesOfAFaultyMotorTheShareOfItsFault) {
  std::vector<MotorEffects> faults(3);
  faults[1].torque_share = 0.25;
  const auto tau = bank_.Step(Torques(1, 2, 3), q_, dq_, 0.001, faults);
  EXPECT_EQ(tau[0], 1);
  EXPECT_EQ(tau[1], 0.5);
}

TEST_F(MotorBankTest, TripsAMotorThatIsTooHotUntilItHasCooled) {
  std::vector<MotorEffects> faults(3);
  const auto torque_at = [&](double heat_c) {
    faults[1].heat_c = heat_c - bank_.winding_c()[0];
    bank_.Step(Torques(1, 2, 3), q_, dq_, 1e-6, faults);  // knows the temperature afterwards
    return bank_.Step(Torques(1, 2, 3), q_, dq_, 1e-6, faults)[1];
  };
  const double trip = spec_.thermal.trip_c;
  EXPECT_EQ(torque_at(trip - 1), 2);
  EXPECT_EQ(torque_at(trip + 1), 0);
  EXPECT_TRUE(bank_.tripped(1));
  EXPECT_FALSE(bank_.tripped(0));
  EXPECT_EQ(torque_at(trip - 5), 0);
  EXPECT_EQ(torque_at(trip - 11), 2);
}

TEST_F(MotorBankTest, MapsMotorSpaceTorquesToTheSerialJoints) {
  RobotCommand command = Torques(1, 2, 3);  // B = 2 is in the pitch slot, A = 3 in the roll slot
  command.joint_space = JointSpace::kMotors;
  const auto tau = bank_.Step(command, q_, dq_, 0.001);
  EXPECT_EQ(tau[0], 1);  // no part of the pair
  EXPECT_EQ(tau[1], 5);  // A + B
  EXPECT_EQ(tau[2], 2);  // ratio (A - B)
}

TEST_F(MotorBankTest, GivesTheSamePowerOnBothSidesOfAParallelJoint) {
  RobotCommand command = Torques(0, -7, 4);
  command.joint_space = JointSpace::kMotors;
  dq_ = {0, 0.3, -1.1};
  const auto tau = bank_.Step(command, q_, dq_, 0.001);
  const auto rate = ParallelJoint(spec_.parallel[0]).ToMotors({.pitch = dq_[1], .roll = dq_[2]});
  EXPECT_NEAR(tau[1] * dq_[1] + tau[2] * dq_[2], 4 * rate.a + -7 * rate.b, 1e-12);
}

// The position of A and B at pitch 0.1, roll 0.2 is 0.5 and -0.3: motors that are told to be there
// want nothing.
TEST_F(MotorBankTest, MeasuresAnglesAndRatesInMotorSpace) {
  RobotCommand command;
  command.joint_space = JointSpace::kMotors;
  command.motors = {{},
                    {.enabled = true, .q = -0.3, .dq = -3, .kp = 100, .kd = 10},
                    {.enabled = true, .q = 0.5, .dq = 5, .kp = 100, .kd = 10}};
  q_ = {0, 0.1, 0.2};
  dq_ = {0, 1, 2};
  const auto tau = bank_.Step(command, q_, dq_, 0.001);
  EXPECT_NEAR(tau[1], 0, 1e-12);
  EXPECT_NEAR(tau[2], 0, 1e-12);
}

// Motors in slots 0 to 2; the fit says 1.5 of kd at the pitch and 0.5 at the roll.
RobotSpec SpecWithKdShares(DynamicsSource use) {
  RobotSpec spec = Spec();
  for (std::size_t i = 0; i < 3; ++i) spec.motors[i].slot = static_cast<int>(i);
  spec.dynamics.use = use;
  spec.dynamics.fitted = {{.slots = {1}, .kd_share = 1.5}, {.slots = {2}, .kd_share = 0.5}};
  return spec;
}

// Every motor is to stand still with kp 0 and kd 10.
RobotCommand Brake() {
  RobotCommand command;
  command.motors.assign(3, {.enabled = true, .kd = 10});
  return command;
}

TEST_F(MotorBankTest, LetsTheFittedShareOfKdActOnEachMotor) {
  const RobotSpec spec = SpecWithKdShares(DynamicsSource::kFitted);
  MotorBank bank(spec);
  dq_ = {1, 1, 1};
  const auto tau = bank.Step(Brake(), q_, dq_, 0.001);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-10, -15, -5}));
}

TEST_F(MotorBankTest, LetsAllOfKdActUnderCatalogueDynamics) {
  const RobotSpec spec = SpecWithKdShares(DynamicsSource::kCatalogue);
  MotorBank bank(spec);
  dq_ = {1, 1, 1};
  const auto tau = bank.Step(Brake(), q_, dq_, 0.001);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-10, -10, -10}));
}

// A = pitch + 2 roll turns at 3, B = pitch - 2 roll at -1: -30 and 10 N·m in motor space.
TEST_F(MotorBankTest, LetsAllOfKdActOnMotorsThatAreCommandedThemselves) {
  const RobotSpec spec = SpecWithKdShares(DynamicsSource::kFitted);
  MotorBank bank(spec);
  RobotCommand command = Brake();
  command.joint_space = JointSpace::kMotors;
  dq_ = {1, 1, 1};
  const auto tau = bank.Step(command, q_, dq_, 0.001);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-10, -20, -80}));
}

TEST_F(MotorBankTest, IgnoresMotorSpaceWhereNothingIsParallel) {
  RobotSpec spec = Spec();
  spec.parallel.clear();
  MotorBank bank(spec);
  RobotCommand command = Torques(1, 2, 3);
  command.joint_space = JointSpace::kMotors;
  const auto tau = bank.Step(command, q_, dq_, 0.001);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{1, 2, 3}));
}

TEST_F(MotorBankTest, ScalesGainsButNotTorquesThatAreFedForward) {
  RobotSpec spec = Spec();
  spec.motors[0].kp_scale = 0.5;
  spec.motors[0].kd_scale = 3;
  MotorBank bank(spec);
  RobotCommand command = Torques(7, 0, 0);
  command.motors[0].q = 1;
  command.motors[0].kp = 100;  // 50 of it
  command.motors[0].kd = 10;   // 30
  dq_[0] = 1;
  EXPECT_EQ(bank.Step(command, q_, dq_, 0.001)[0], 7 + 50 - 30);
}

TEST_F(MotorBankTest, ScalesGainsInMotorSpaceToo) {
  RobotSpec spec = Spec();
  spec.motors[1].kp_scale = 0.5;  // of B, which is in the pitch slot
  MotorBank bank(spec);
  RobotCommand command = Torques(0, 0, 0);
  command.joint_space = JointSpace::kMotors;
  command.motors[1].q = 1;
  command.motors[1].kp = 100;
  const auto tau = bank.Step(command, q_, dq_, 0.001);
  EXPECT_EQ(tau[1], 50);
  EXPECT_EQ(tau[2], -100);  // ratio (A - B)
}

TEST_F(MotorBankTest, IsWeakerThanMeantAtAndBelowItsLimit) {
  RobotSpec spec = Spec();
  spec.motors[0].torque_limit = 10;
  spec.motors[0].strength = 0.5;
  MotorBank bank(spec);
  EXPECT_EQ(bank.Step(Torques(4, 0, 0), q_, dq_, 0.001)[0], 2);
  EXPECT_EQ(bank.Step(Torques(90, 0, 0), q_, dq_, 0.001)[0], 5);
}

TEST_F(MotorBankTest, BrakesWithItsLockGainWhileNotEnabledWhateverElseItIsTold) {
  RobotSpec spec = Spec();
  spec.motors[0].lock_kd = 0.5;
  spec.motors[0].kd_scale = 3;
  MotorBank bank(spec);
  RobotCommand command = Torques(NAN, 7, 0);
  command.motors[0].enabled = command.motors[1].enabled = false;
  dq_ = {2, 2, 2};
  const auto tau = bank.Step(command, q_, dq_, 0.001);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-1, 0, 0}));
}

TEST_F(MotorBankTest, StartsAtItsTemperatureOfRest) {
  for (const double temperature : bank_.winding_c()) EXPECT_EQ(temperature, 25);
}

TEST_F(MotorBankTest, StaysAtItsTemperatureOfRestWhileIdle) {
  for (int i = 0; i < 1000; ++i) bank_.Step(Torques(0, 0, 0), q_, dq_, 0.1);
  for (const double temperature : bank_.winding_c()) EXPECT_EQ(temperature, 25);
}

TEST_F(MotorBankTest, WarmsTheMotorThatWorksAndNoOther) {
  // 10 N·m rise by 10 °C in the end, and by 1 - 1/e of it within the time constant of 100 s.
  for (int i = 0; i < 10000; ++i) bank_.Step(Torques(0, -10, 0), q_, dq_, 0.01);
  EXPECT_NEAR(bank_.winding_c()[1], 25 + 10 * (1 - std::exp(-1)), 0.01);
  for (int i = 0; i < 10000; ++i) bank_.Step(Torques(0, -10, 0), q_, dq_, 0.1);
  EXPECT_NEAR(bank_.winding_c()[1], 35, 0.01);
  EXPECT_EQ(bank_.winding_c()[0], 25);
  EXPECT_EQ(bank_.winding_c()[2], 25);
}

TEST_F(MotorBankTest, HeatsByTheTorqueItGivesNotByTheOneItWants) {
  RobotSpec spec = Spec();
  spec.motors[0].torque_limit = 10;
  spec.motors[1].torque_limit = 10;
  spec.motors[1].rise_per_nm2_c = 0.2;  // its own
  MotorBank bank(spec);
  for (int i = 0; i < 10000; ++i) bank.Step(Torques(500, 500, 0), q_, dq_, 0.1);
  EXPECT_NEAR(bank.winding_c()[0], 35, 0.01);
  EXPECT_NEAR(bank.winding_c()[1], 45, 0.01);
}

}  // namespace
}  // namespace understudy::robot
