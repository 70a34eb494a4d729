// Tests what torque motors give: order, limits, gains, clamps, faults.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/robot/motor_bank_fixture.h"

namespace understudy::robot {
namespace {

TEST_F(MotorBankTest, GivesNoTorqueBeforeTheFirstStep) {
  EXPECT_EQ(std::vector(bank_.torque().begin(), bank_.torque().end()),
            (std::vector<double>{0, 0, 0}));
}

TEST_F(MotorBankTest, KeepsMotorOrderInPitchRoll) {
  const auto tau = Step(&bank_, Torques(1, 2, 3));
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(tau.data(), bank_.torque().data());
}

TEST_F(MotorBankTest, CutsEachMotorToItsOwnLimit) {
  RobotSpec spec = Spec();
  spec.motors[0].torque_limit = 5;
  MotorBank bank(spec, kDt);
  const auto tau = Step(&bank, Torques(9, 9, -9));
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{5, 9, -9}));
}

TEST_F(MotorBankTest, GivesOfAFaultyMotorTheShareOfItsFault) {
  std::vector<MotorEffects> faults(3);
  faults[0].torque_share = 0.25;
  const auto tau = bank_.Step({.command = Torques(2, 2, 3), .q = q_, .dq = dq_, .faults = faults});
  EXPECT_EQ(tau[0], 0.5);
  EXPECT_EQ(tau[1], 2);
  EXPECT_EQ(tau[2], 3);
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
  MotorBank bank(spec, kDt);
  dq_ = {1, 1, 1};
  const auto tau = Step(&bank, Brake());
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-10, -15, -5}));
}

TEST_F(MotorBankTest, LetsAllOfKdActUnderCatalogueDynamics) {
  const RobotSpec spec = SpecWithKdShares(DynamicsSource::kCatalogue);
  MotorBank bank(spec, kDt);
  dq_ = {1, 1, 1};
  const auto tau = Step(&bank, Brake());
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-10, -10, -10}));
}

// A = pitch + 2 roll turns at 3, B = pitch - 2 roll at -1: -30 and 10 N·m in motor space.
TEST_F(MotorBankTest, LetsAllOfKdActOnMotorsThatAreCommandedThemselves) {
  const RobotSpec spec = SpecWithKdShares(DynamicsSource::kFitted);
  MotorBank bank(spec, kDt);
  const RobotCommand command = InMotorSpace(Brake());
  dq_ = {1, 1, 1};
  const auto tau = Step(&bank, command);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-10, -20, -80}));
}

TEST_F(MotorBankTest, TakesACommandedAngleBeyondItsClampForTheEnd) {
  RobotSpec spec = Spec();
  for (MotorSpec& motor : spec.motors) motor.q_clamp = {-0.5, 0.25};
  MotorBank bank(spec, kDt);
  const auto of = [&](double q) {
    RobotCommand command = Torques(0, 0, 0);
    for (MotorCommand& motor : command.motors) motor.q = q, motor.kp = 10;
    return TorquesOf(&bank, command);
  };
  EXPECT_EQ(of(0.2), (std::vector<double>{2, 2, 2}));
  EXPECT_EQ(of(0.3), (std::vector<double>{2.5, 2.5, 2.5}));
  EXPECT_EQ(of(-9), (std::vector<double>{-5, -5, -5}));
  EXPECT_EQ(of(kNoPosition), (std::vector<double>{0, 0, 0}));
}

TEST_F(MotorBankTest, ClampsNoAngleOfAPairsOwnMotors) {
  RobotSpec spec = Spec();
  for (MotorSpec& motor : spec.motors) motor.q_clamp = {-0.5, 0.25};
  MotorBank clamping(spec, kDt);
  RobotCommand command = InMotorSpace(Torques(0, 0, 0));
  command.motors[1].q = command.motors[2].q = 0.7;
  command.motors[1].kp = command.motors[2].kp = 10;
  EXPECT_EQ(TorquesOf(&clamping, command), TorquesOf(&bank_, command));
}

TEST_F(MotorBankTest, TakesAnyAngleWithoutAClamp) {
  RobotCommand command = Torques(0, 0, 0);
  command.motors[0].q = 9;
  command.motors[0].kp = 10;
  EXPECT_EQ(Step(&bank_, command)[0], 90);
}

TEST_F(MotorBankTest, ScalesGainsButNotTorquesThatAreFedForward) {
  RobotSpec spec = Spec();
  spec.motors[0].kp_scale = 0.5;
  spec.motors[0].kd_scale = 3;
  MotorBank bank(spec, kDt);
  RobotCommand command = Torques(7, 0, 0);
  command.motors[0].q = 1;
  command.motors[0].kp = 100;  // 50 of it
  command.motors[0].kd = 10;   // 30
  dq_[0] = 1;
  EXPECT_EQ(Step(&bank, command)[0], 7 + 50 - 30);
}

TEST_F(MotorBankTest, IsWeakerThanMeantAtAndBelowItsLimit) {
  RobotSpec spec = Spec();
  spec.motors[0].torque_limit = 10;
  spec.motors[0].strength = 0.5;
  MotorBank bank(spec, kDt);
  EXPECT_EQ(Step(&bank, Torques(4, 0, 0))[0], 2);
  EXPECT_EQ(Step(&bank, Torques(90, 0, 0))[0], 5);
}

TEST_F(MotorBankTest, BrakesWithItsLockGainWhileNotEnabledWhateverElseItIsTold) {
  RobotSpec spec = Spec();
  spec.motors[0].lock_kd = 0.5;
  spec.motors[0].kd_scale = 3;
  MotorBank bank(spec, kDt);
  RobotCommand command = Torques(NAN, 7, 0);
  command.motors[0].enabled = command.motors[1].enabled = false;
  dq_ = {2, 2, 2};
  const auto tau = Step(&bank, command);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-1, 0, 0}));
}

TEST_F(MotorBankTest, OutlivesAWorldThatDiverges) {
  const RobotCommand command = Torques(1, 0, 0);
  dq_ = {NAN, 0, 0};
  bank_.Step({.command = command, .q = q_, .dq = dq_, .friction_w = dq_});
  dq_ = {0, 0, 0};
  Work(&bank_, command, 1);
  EXPECT_TRUE(std::isfinite(bank_.winding_c()[0]));
  EXPECT_TRUE(std::isfinite(bank_.power()));
}

}  // namespace
}  // namespace understudy::robot
