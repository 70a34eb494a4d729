// Tests two motors that drive two joints together: limits, faults and commands of either.
#include <vector>

#include <gtest/gtest.h>

#include "tests/robot/motor_bank_fixture.h"

namespace understudy::robot {
namespace {

// Pitch 8 and roll 8 are 6 of A and 2 of B: without B 6 of pitch and, through the ratio of 2, 12 of
// roll are left.
TEST_F(MotorBankTest, LosesOfAPairTheMotorThatIsFaulty) {
  std::vector<MotorEffects> faults(3);
  faults[1].torque_share = 0;  // B is in pitch's place
  const auto tau = bank_.Step({.command = Torques(0, 8, 8), .q = q_, .dq = dq_, .faults = faults});
  EXPECT_EQ(tau[1], 6);
  EXPECT_EQ(tau[2], 12);
}

// A and B have 10 N·m each. Pitch 20 takes all of both, so that no roll is left beside it.
TEST_F(MotorBankTest, LimitsTheMotorsOfAPairAndNotItsJoints) {
  RobotSpec spec = Spec();
  spec.motors[1].torque_limit = 20;
  MotorBank bank(spec, kDt);
  EXPECT_EQ(TorquesOf(&bank, Torques(0, 50, 0)), (std::vector<double>{0, 20, 0}));
  EXPECT_EQ(TorquesOf(&bank, Torques(0, 0, 90)), (std::vector<double>{0, 0, 40}));
  EXPECT_EQ(TorquesOf(&bank, Torques(0, 20, 40)), (std::vector<double>{0, 10, 20}));
  spec.motors[2].torque_limit = 30;  // of the joint
  MotorBank weaker(spec, kDt);
  EXPECT_EQ(TorquesOf(&weaker, Torques(0, 0, 90)), (std::vector<double>{0, 0, 30}));
}

// At twice the joint's torque per motor, and half of what they are meant to give.
TEST_F(MotorBankTest, LimitsTheJointOfAPairByWhatItsMotorIsMadeToGive) {
  RobotSpec spec = Spec();
  spec.motors[2].torque_limit = 30;
  for (MotorSpec& motor : spec.motors) motor.strength = 0.5;
  MotorBank bank(spec, kDt);
  EXPECT_EQ(TorquesOf(&bank, Torques(0, 0, 90)), (std::vector<double>{0, 0, 15}));
}

// At pitch 6, roll 4 rad/s A turns at 14 and B at -2: half of A's torque is left beyond its knee.
TEST_F(MotorBankTest, LimitsAMotorOfAPairByItsOwnSpeed) {
  RobotSpec spec = Spec();
  spec.motors[1].torque_limit = 20;
  spec.motors[1].knee_speed = 12;
  spec.motors[1].no_load_speed = 16;
  MotorBank bank(spec, kDt);
  dq_ = {0, 6, 4};
  EXPECT_EQ(TorquesOf(&bank, Torques(0, 20, 0)), (std::vector<double>{0, 15, -10}));
}

TEST_F(MotorBankTest, MapsMotorSpaceTorquesToTheSerialJoints) {
  RobotCommand command =
      InMotorSpace(Torques(1, 2, 3));  // B = 2 is in the pitch slot, A = 3 in the roll slot
  const auto tau = Step(&bank_, command);
  EXPECT_EQ(tau[0], 1);  // no part of the pair
  EXPECT_EQ(tau[1], 5);  // A + B
  EXPECT_EQ(tau[2], 2);  // ratio (A - B)
}

TEST_F(MotorBankTest, GivesTheSamePowerOnBothSidesOfAParallelJoint) {
  RobotCommand command = InMotorSpace(Torques(0, -7, 4));
  dq_ = {0, 0.3, -1.1};
  const auto tau = Step(&bank_, command);
  const auto rate = ParallelJoint(spec_.parallel[0]).ToMotors({.pitch = dq_[1], .roll = dq_[2]});
  EXPECT_NEAR(tau[1] * dq_[1] + tau[2] * dq_[2], 4 * rate.a + -7 * rate.b, 1e-12);
}

// The position of A and B at pitch 0.1, roll 0.2 is 0.5 and -0.3: motors that are told to be there
// want nothing.
TEST_F(MotorBankTest, MeasuresAnglesAndRatesInMotorSpace) {
  const RobotCommand command =
      InMotorSpace({.motors = {{},
                               {.enabled = true, .q = -0.3, .dq = -3, .kp = 100, .kd = 10},
                               {.enabled = true, .q = 0.5, .dq = 5, .kp = 100, .kd = 10}}});
  q_ = {0, 0.1, 0.2};
  dq_ = {0, 1, 2};
  const auto tau = Step(&bank_, command);
  EXPECT_NEAR(tau[1], 0, 1e-12);
  EXPECT_NEAR(tau[2], 0, 1e-12);
}

TEST_F(MotorBankTest, IgnoresMotorSpaceWhereNothingIsParallel) {
  RobotSpec spec = Spec();
  spec.parallel.clear();
  MotorBank bank(spec, kDt);
  RobotCommand command = InMotorSpace(Torques(1, 2, 3));
  const auto tau = Step(&bank, command);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{1, 2, 3}));
}

TEST_F(MotorBankTest, ScalesGainsInMotorSpaceToo) {
  RobotSpec spec = Spec();
  spec.motors[1].kp_scale = 0.5;  // of B, which is in the pitch slot
  MotorBank bank(spec, kDt);
  RobotCommand command = InMotorSpace(Torques(0, 0, 0));
  command.motors[1].q = 1;
  command.motors[1].kp = 100;
  const auto tau = Step(&bank, command);
  EXPECT_EQ(tau[1], 50);
  EXPECT_EQ(tau[2], -100);  // ratio (A - B)
}

}  // namespace
}  // namespace understudy::robot
