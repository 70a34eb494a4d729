#include "motion/humanoid/senses.h"

#include <gmock/gmock.h>

#include "tests/motion/rig.h"
#include "tests/support/mujoco_test.h"

namespace understudy::motion {
namespace {

class HumanoidSensesTest : public test::MujocoTest {};

TEST_F(HumanoidSensesTest, PassesOnWhatAWalkingControllerNeeds) {
  const config::Config config = ConfigOf("g1");
  const physics::MujocoWorld world = PhysicsOf(config);
  HumanoidSenses senses(world.robot().nominal(), config.robots[0].spec);
  std::vector<robot::MotorReading> motors(config.robots[0].spec.motors.size());
  motors[3].q = 0.4;
  motors[3].dq = -1.5;
  const std::array forces{2.0, 200.0};
  authority::MotionInput input{.motors = motors, .imu = {}, .foot_force = forces};
  input.imu.R_WI = Eigen::Quaterniond(0.8, 0.6, 0, 0);
  input.imu.w_WI_I = {0.1, 0.2, 0.3};
  senses.Begin(input);
  const HumanoidReading& reading = senses.reading();
  EXPECT_EQ(reading.q[3], 0.4);
  EXPECT_EQ(reading.dq[3], -1.5);
  EXPECT_EQ(reading.imu.R_WI.coeffs(), input.imu.R_WI.coeffs());
  EXPECT_EQ(reading.imu.w_WI_I, input.imu.w_WI_I);
  EXPECT_THAT(reading.contacts, testing::ElementsAre(false, true));
}

}  // namespace
}  // namespace understudy::motion
