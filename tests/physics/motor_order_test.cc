#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::physics {
namespace {

// Only where the orders differ can a confused one be seen.
class MotorOrderTest : public test::MujocoTest {
 protected:
  void SetUp() override {
    const auto motors = test::MotorOrder(spec_);
    const auto joints = test::JointOrder(world_.model());
    const auto actuators = test::ActuatorOrder(world_.model());
    ASSERT_EQ(motors.size(), joints.size());
    ASSERT_EQ(motors.size(), actuators.size());
    ASSERT_NE(motors, joints);
    ASSERT_NE(motors, actuators);
    ASSERT_NE(joints, actuators);
  }

  int Joint(std::size_t motor) const {
    return mj_name2id(&world_.model(), mjOBJ_JOINT, spec_.motors[motor].joint.c_str());
  }
  double Q(std::size_t motor) const {
    return world_.data().qpos[world_.model().jnt_qposadr[Joint(motor)]];
  }
  double Rate(std::size_t motor) const {
    return world_.data().qvel[world_.model().jnt_dofadr[Joint(motor)]];
  }

  const robot::RobotSpec spec_ = test::FixtureRobot();
  MujocoWorld world_ = test::FixtureWorld(spec_);
};

TEST_F(MotorOrderTest, ResetSetsEachJointByName) {
  const std::vector<double> q = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  world_.robot().Reset({.q = q, .height = 5});
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(Q(i), q[i]) << spec_.motors[i].joint;
    EXPECT_EQ(world_.robot().q()[i], q[i]);
  }
}

TEST_F(MotorOrderTest, TorqueTurnsTheJointOfItsMotorAndIsReadThere) {
  for (std::size_t driven = 0; driven < 6; ++driven) {
    world_.robot().Reset({.q = spec_.hanging.q, .height = 5});
    std::vector<double> tau(6, 0.0);
    tau[driven] = 1;
    world_.BeginStep();
    world_.robot().Drive(tau);
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
    world_.BeginStep();
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(world_.robot().dq()[i], Rate(i));
      // The others only feel the recoil of the trunk.
      if (i != driven) {
        EXPECT_GT(world_.robot().dq()[driven], 2 * world_.robot().dq()[i]) << spec_.motors[i].joint;
      }
    }
    world_.robot().Drive(tau);
    EXPECT_EQ(world_.EndStep(), StepHealth::kFine);
  }
}

TEST_F(MotorOrderTest, FeetAreInSpecOrder) {
  // Pushed down at its front right corner, it leans on that foot most.
  world_.robot().Reset({.q = spec_.standing.q, .height = spec_.standing.height});
  const int base = world_.robot().Body("base");
  for (int i = 0; i < 500; ++i) {
    world_.BeginStep();
    world_.AddForce(base, world_.Point(base, {0.2, -0.1, 0}).p_WP, {0, 0, -40});
    world_.robot().Drive(test::Hold(world_.robot(), spec_.standing.q));
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  }
  std::vector<double> force(4);
  world_.robot().FootForces(force);
  ASSERT_EQ(spec_.feet[0].name, "FR");
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(force[0], force[i] + 10) << spec_.feet[i].name;
}

}  // namespace
}  // namespace understudy::physics
