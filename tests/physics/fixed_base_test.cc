#include <cmath>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "config/load.h"
#include "physics/mujoco_world.h"
#include "physics/world_model.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::physics {
namespace {

const std::filesystem::path kSource = UNDERSTUDY_SOURCE_DIR;
const std::filesystem::path kExample = kSource / "examples" / "two_joint_arm";

// The arm of the documentation, whose column stands on the ground.
class FixedBaseTest : public test::MujocoTest {
 protected:
  FixedBaseTest()
      : config_(
            config::LoadConfig({.robot = kExample / "arm.yaml", .files = {}, .sets = {}}, kSource)),
        world_(LoadWorldModel(
                   {{config_.robots[0].spec, kSource / "models" / config_.robots[0].spec.model}},
                   test::FixtureFile("fixture_ground.xml"), 0.001),
               {{config_.robots[0].spec}}) {}

  config::Config config_;
  MujocoWorld world_;
};

TEST_F(FixedBaseTest, HasTheMotorsOfItsDescription) { EXPECT_EQ(world_.robot().q().size(), 2u); }

TEST_F(FixedBaseTest, StandsWhereItsFileHasItWhateverTheHeight) {
  EXPECT_EQ(world_.robot().base().p_WB, Eigen::Vector3d(0, 0, 0.5));
  world_.robot().Reset({.q = {0.5, -0.5}, .height = 3});
  EXPECT_EQ(world_.robot().base().p_WB, Eigen::Vector3d(0, 0, 0.5));
  EXPECT_EQ(world_.robot().q()[0], 0.5);
  EXPECT_EQ(world_.robot().q()[1], -0.5);
}

TEST_F(FixedBaseTest, IsAlwaysClamped) {
  EXPECT_TRUE(world_.robot().clamped());
  world_.robot().Clamp(false);
  EXPECT_TRUE(world_.robot().clamped());
  world_.robot().Clamp(true);
  EXPECT_EQ(world_.model().neq, 0);
}

TEST_F(FixedBaseTest, StaysWhileTheArmSwings) {
  world_.robot().Reset({.q = {1.0, 0.5}, .height = 0});
  for (int i = 0; i < 1000; ++i) {
    world_.BeginStep();
    world_.robot().Drive(std::vector{0.0, 0.0});
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  }
  EXPECT_NE(world_.robot().q()[0], 1.0);
  EXPECT_EQ(world_.robot().base().p_WB, Eigen::Vector3d(0, 0, 0.5));
  EXPECT_EQ(world_.robot().base().v_WB_W, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(world_.robot().tilt(), 0);
}

TEST_F(FixedBaseTest, FeelsGravityInItsInertialUnit) {
  world_.robot().Reset({.q = {0.0, 0.0}, .height = 0});
  const double gravity = -world_.model().opt.gravity[2];
  EXPECT_LT((world_.robot().Imu().f_WI_I - Eigen::Vector3d(0, 0, gravity)).norm(), 1e-9);
}

TEST_F(FixedBaseTest, HangsStraightDownWithoutTorque) {
  world_.robot().Reset({.q = {0.0, 0.0}, .height = 0});
  for (int i = 0; i < 100; ++i) {
    world_.BeginStep();
    world_.robot().Drive(std::vector{0.0, 0.0});
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  }
  EXPECT_NEAR(world_.robot().q()[0], 0, 1e-9);
}

}  // namespace
}  // namespace understudy::physics
