#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "physics/world_model.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

// A ball of 1 kg and 1 kg·m² without a motor. Its second unit sits upside down.
constexpr char kBall[] = R"(
<mujoco>
  <option gravity="0 0 %s"/>
  <worldbody>
    <body name="ball">
      <freejoint/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <site name="imu"/>
      <site name="back" quat="0 1 0 0"/>
    </body>
  </worldbody>
</mujoco>)";

MujocoWorld Ball(const std::string& gravity) {
  const test::TemporaryFolder folder;
  std::string text = kBall;
  text.replace(text.find("%s"), 2, gravity);
  robot::RobotSpec spec;
  spec.base_body = "ball";
  spec.crane_body = "ball";
  spec.imu.site = "imu";
  spec.imu.secondary_site = "back";
  MujocoWorld world(
      LoadWorldModel({{spec, folder.Write("ball.xml", text)}},
                     folder.Write("space.xml", "<mujoco><worldbody/></mujoco>"), 0.001),
      {{spec}});
  world.robot().Reset({.q = {}, .height = 10});
  return world;
}

void ExpectNear(const Eigen::Vector3d& actual, const Eigen::Vector3d& expected,
                double tolerance = 1e-12) {
  EXPECT_LT((actual - expected).norm(), tolerance)
      << actual.transpose() << " is not " << expected.transpose();
}

class BallTest : public test::MujocoTest {
 protected:
  void Step(MujocoWorld* world) {
    world->BeginStep();
    EXPECT_EQ(world->EndStep(), StepHealth::kFine);
  }
  // One step under a force on the point p_WP.
  void Push(MujocoWorld* world, const Eigen::Vector3d& p_WP, const Eigen::Vector3d& force_W) {
    world->BeginStep();
    world->AddForce(world->robot().Body("ball"), p_WP, force_W);
    EXPECT_EQ(world->EndStep(), StepHealth::kFine);
  }
};

TEST_F(BallTest, FeelsNothingWhileItFalls) {
  MujocoWorld world = Ball("-10");
  for (int i = 0; i < 100; ++i) Step(&world);
  ExpectNear(world.robot().Imu().f_WI_I, {0, 0, 0});
  ExpectNear(world.robot().base().v_WB_W,
             {0, 0, -0.99});  // of the instant before the last step's end
}

TEST_F(BallTest, FeelsWhatCarriesIt) {
  MujocoWorld world = Ball("-10");
  Push(&world, {0, 0, 10}, {0, 0, 10});
  ExpectNear(world.robot().Imu().f_WI_I, {0, 0, 10});
  ExpectNear(world.robot().SecondaryImu().f_WI_I, {0, 0, -10});  // its own z points down
}

// Position, rate and acceleration of one t: at rest at 10 m with 2 m/s² in the step of the force,
// 0.002 m/s without any in the next.
TEST_F(BallTest, ReadsPositionRateAndAccelerationOfOneInstant) {
  MujocoWorld world = Ball("0");
  Push(&world, {0, 0, 10}, {2, 0, 0});
  ExpectNear(world.robot().base().p_WB, {0, 0, 10});
  ExpectNear(world.robot().base().v_WB_W, {0, 0, 0});
  ExpectNear(world.robot().Imu().f_WI_I, {2, 0, 0});
  Step(&world);
  ExpectNear(world.robot().base().p_WB, {2e-6, 0, 10});
  ExpectNear(world.robot().base().v_WB_W, {0.002, 0, 0});
  ExpectNear(world.robot().Imu().f_WI_I, {0, 0, 0});
}

TEST_F(BallTest, MovesByForceOverMassForOneStepOnly) {
  MujocoWorld world = Ball("0");
  Push(&world, {0, 0, 10}, {0, 3, 0});
  for (int i = 0; i < 5; ++i) {
    Step(&world);
    ExpectNear(world.robot().base().v_WB_W, {0, 0.003, 0});
  }
}

TEST_F(BallTest, AddsUpForces) {
  MujocoWorld world = Ball("0");
  world.BeginStep();
  world.AddForce(world.robot().Body("ball"), {0, 0, 10}, {1, 0, 0});
  world.AddForce(world.robot().Body("ball"), {0, 0, 10}, {2, 5, 0});
  ASSERT_EQ(world.EndStep(), StepHealth::kFine);
  ExpectNear(world.robot().Imu().f_WI_I, {3, 5, 0});
}

TEST_F(BallTest, ForgetsAForceOnReset) {
  MujocoWorld world = Ball("0");
  world.AddForce(world.robot().Body("ball"), {0, 0, 10}, {1, 0, 0});
  world.robot().Reset({.q = {}, .height = 10});
  Step(&world);
  ExpectNear(world.robot().Imu().f_WI_I, {0, 0, 0});
}

struct Spin {
  Eigen::Vector3d arm;    // from the centre to where the force acts
  Eigen::Vector3d force;  // N
  Eigen::Vector3d axis;   // arm × force
};

TEST_F(BallTest, GyroFollowsTheRightHandRule) {
  const Spin spins[] = {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
                        {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
                        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (const Spin& spin : spins) {
    MujocoWorld world = Ball("0");
    Push(&world, Eigen::Vector3d(0, 0, 10) + spin.arm, spin.force);
    Step(&world);
    ExpectNear(world.robot().Imu().w_WI_I, 0.001 * spin.axis);
    ExpectNear(world.robot().SecondaryImu().w_WI_I,
               0.001 * Eigen::Vector3d(spin.axis.x(), -spin.axis.y(), -spin.axis.z()));
  }
}

TEST_F(BallTest, KnowsHowItsUnitsAreTurned) {
  MujocoWorld world = Ball("0");
  EXPECT_NEAR(world.robot().Imu().R_WI.angularDistance(Eigen::Quaterniond::Identity()), 0, 1e-9);
  EXPECT_NEAR(world.robot().SecondaryImu().R_WI.angularDistance(Eigen::Quaterniond(0, 1, 0, 0)), 0,
              1e-9);
}

// 1 N along y at 1 m along x for 1 ms: the centre moves with 1 mm/s and the ball turns with 1
// mrad/s.
TEST_F(BallTest, PointVelocityIsThatOfItsPlaceOnTheBody) {
  MujocoWorld world = Ball("0");
  Push(&world, {1, 0, 10}, {0, 1, 0});
  world.BeginStep();
  const int ball = world.robot().Body("ball");
  ExpectNear(world.Point(ball, {0, 0, 0}).v_WP_W, {0, 0.001, 0});
  ExpectNear(world.Point(ball, {1, 0, 0}).v_WP_W, {0, 0.002, 0}, 1e-8);
  ExpectNear(world.Point(ball, {-1, 0, 0}).v_WP_W, {0, 0, 0}, 1e-8);
  ExpectNear(world.Point(ball, {0, 1, 0}).v_WP_W, {-0.001, 0.001, 0}, 1e-8);
}

TEST_F(BallTest, TiltIsTheAngleToTheVertical) {
  MujocoWorld world = Ball("0");
  EXPECT_EQ(world.robot().tilt(), 0);
  // A quarter turn about y in 1 s: 1571 N·m for 1 ms, and a second to wait.
  Push(&world, {0, 0, 11}, {1000 * std::numbers::pi / 2, 0, 0});
  for (int i = 0; i < 1001; ++i) Step(&world);
  EXPECT_NEAR(world.robot().tilt(), std::numbers::pi / 2, 0.01);
}

TEST_F(BallTest, WeighsMassTimesGravity) {
  EXPECT_NEAR(Ball("-10").robot().weight(), 10, 1e-12);
  EXPECT_EQ(Ball("0").robot().weight(), 0);
}

TEST_F(BallTest, HasNoBodyOfAnotherName) {
  const MujocoWorld world = Ball("0");
  EXPECT_THROW(world.robot().Body("cube"), SetupError);
}

}  // namespace
}  // namespace understudy::physics
