#include <gtest/gtest.h>

#include "physics/crane.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::physics {
namespace {

// The fixture robot of 60 N on the crane.
class CraneWorldTest : public test::MujocoTest {
 protected:
  CraneWorldTest() {
    world_.robot().Reset({.q = spec_.hanging.q, .height = spec_.hanging.height});
    crane_.Attach(Hooks(), world_.robot().weight());
  }

  int Base() const { return world_.robot().Body("base"); }
  Crane::Hooks Hooks() const {
    return {world_.Point(Base(), {0, Crane::kHookOffset, 0.1}),
            world_.Point(Base(), {0, -Crane::kHookOffset, 0.1})};
  }

  void Step() {
    world_.BeginStep();
    const Crane::Hooks hooks = Hooks();
    const Crane::Pulls pulls = crane_.Step(hooks, world_.timestep());
    for (std::size_t i = 0; i < hooks.size(); ++i) world_.AddForce(Base(), hooks[i].p_WP, pulls[i]);
    world_.robot().Drive(test::Hold(world_.robot(), spec_.hanging.q));
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  }
  double Height() const { return world_.robot().base().p_WB.z(); }

  const robot::RobotSpec spec_ = test::FixtureRobot();
  MujocoWorld world_ = test::FixtureWorld(spec_);
  Crane crane_{CraneConfig{}};
};

TEST_F(CraneWorldTest, HangsInEquilibriumFromTheFirstStep) {
  for (int i = 0; i < 2000; ++i) {
    Step();
    ASSERT_NEAR(Height(), 1, 1e-6) << i;
    ASSERT_NEAR(crane_.tension(), 60, 0.1) << i;
  }
}

TEST_F(CraneWorldTest, FeelsTheTetherAsItFeelsTheGround) {
  Step();
  EXPECT_LT((world_.robot().Imu().f_WI_I - Eigen::Vector3d(0, 0, 10)).norm(), 1e-6);
}

TEST_F(CraneWorldTest, FollowsTheWinchDown) {
  crane_.Lower(0.3);
  for (int i = 0; i < 1000; ++i) Step();
  EXPECT_NEAR(world_.robot().base().v_WB_W.z(), -0.1, 0.01);
  EXPECT_NEAR(Height(), 0.9, 0.01);
  for (int i = 0; i < 4000; ++i) Step();
  EXPECT_NEAR(Height(), 0.7, 0.001);
}

TEST_F(CraneWorldTest, StandsWithASlackTetherWhenItIsLoweredFarEnough) {
  crane_.Lower(1);
  for (int i = 0; i < 12'000; ++i) Step();
  EXPECT_NEAR(Height(), 0.3, 0.01);
  EXPECT_EQ(crane_.tension(), 0);
  EXPECT_LT(world_.robot().tilt(), 0.01);
}

TEST_F(CraneWorldTest, FallsWhenItIsReleased) {
  crane_.Release();
  for (int i = 0; i < 200; ++i) Step();
  EXPECT_NEAR(Height(), 0.8, 0.01);  // 10 / 2 · 0.2²
}

}  // namespace
}  // namespace understudy::physics
