#include "authority/command_delay.h"

#include <gtest/gtest.h>

namespace understudy::authority {
namespace {

robot::RobotCommand Torque(double tau) { return {.motors = {{.enabled = true, .tau = tau}}}; }

TEST(CommandDelayTest, PassesEachCommandOnAtOnceWhereThereIsNoDelay) {
  CommandDelay delay(0, Torque(0));
  for (const double tau : {1, 2, 3}) EXPECT_EQ(delay.Pass(Torque(tau)).motors[0].tau, tau);
}

TEST(CommandDelayTest, GivesEachCommandAfterItsStepsAndTheStartCommandBefore) {
  CommandDelay delay(2, Torque(9));
  std::vector<double> out;
  for (const double tau : {1, 2, 3, 4, 5}) out.push_back(delay.Pass(Torque(tau)).motors[0].tau);
  EXPECT_EQ(out, (std::vector<double>{9, 9, 1, 2, 3}));
}

TEST(CommandDelayTest, CarriesTheJointSpaceOfACommandWithIt) {
  CommandDelay delay(1, Torque(0));
  robot::RobotCommand motors = Torque(1);
  motors.joint_space = robot::JointSpace::kMotors;
  EXPECT_EQ(delay.Pass(motors).joint_space, robot::JointSpace::kPitchRoll);
  EXPECT_EQ(delay.Pass(Torque(2)).joint_space, robot::JointSpace::kMotors);
}

TEST(CommandDelayTest, ForgetsWhatWaitsWhenTheRobotStartsAnew) {
  CommandDelay delay(2, Torque(9));
  for (const double tau : {1, 2, 3}) delay.Pass(Torque(tau));
  delay.Restart(Torque(9));
  EXPECT_EQ(delay.Pass(Torque(4)).motors[0].tau, 9);
  EXPECT_EQ(delay.Pass(Torque(5)).motors[0].tau, 9);
  EXPECT_EQ(delay.Pass(Torque(6)).motors[0].tau, 4);
}

}  // namespace
}  // namespace understudy::authority
