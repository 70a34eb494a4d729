#include "physics/mujoco_world.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::physics {
namespace {

class WorldTest : public test::MujocoTest {
 protected:
  void HoldFor(int steps, const std::vector<double>& q) {
    for (int i = 0; i < steps; ++i) {
      world_.BeginStep();
      world_.robot().Drive(test::Hold(world_.robot(), q));
      ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
    }
  }

  const robot::RobotSpec spec_ = test::FixtureRobot();
  MujocoWorld world_ = test::FixtureWorld(spec_);
};

TEST_F(WorldTest, IsInThePoseOfItsFileBeforeAnything) {
  EXPECT_EQ(world_.robot().base().p_WB, Eigen::Vector3d(0, 0, 0.3));
  EXPECT_EQ(world_.robot().tilt(), 0);
  EXPECT_EQ(world_.Point(world_.robot().Body("base"), {0, 0, 0.1}).p_WP,
            Eigen::Vector3d(0, 0, 0.4));
  EXPECT_FALSE(world_.robot().clamped());
}

TEST_F(WorldTest, ReadsTheStartStateAfterReset) {
  world_.robot().Reset({.q = std::vector{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, .height = 2});
  EXPECT_EQ(world_.robot().base().p_WB, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(world_.robot().base().v_WB_W, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(world_.robot().tilt(), 0);
  for (const double rate : world_.robot().dq()) EXPECT_EQ(rate, 0);
}

TEST_F(WorldTest, StartsAfreshOnReset) {
  const auto fall = [this] {
    world_.robot().Reset({.q = spec_.standing.q, .height = 0.4});
    HoldFor(300, spec_.standing.q);
    return std::vector(world_.data().qpos, world_.data().qpos + world_.model().nq);
  };
  const auto first = fall();
  EXPECT_EQ(first, fall());
}

TEST_F(WorldTest, WeighsSixBodies) { EXPECT_NEAR(world_.robot().weight(), 60, 1e-9); }

TEST_F(WorldTest, ReadsGravityUpwardsWhenItStands) {
  world_.robot().Reset({.q = spec_.standing.q, .height = spec_.standing.height});
  HoldFor(2000, spec_.standing.q);
  EXPECT_LT((world_.robot().Imu().f_WI_I - Eigen::Vector3d(0, 0, 10)).norm(), 0.01);
  EXPECT_LT((world_.robot().SecondaryImu().f_WI_I - Eigen::Vector3d(0, 0, -10)).norm(), 0.01);
}

TEST_F(WorldTest, FootForcesSumToTheWeight) {
  world_.robot().Reset({.q = spec_.standing.q, .height = spec_.standing.height});
  HoldFor(2000, spec_.standing.q);
  std::vector<double> force(4);
  world_.robot().FootForces(force);
  EXPECT_NEAR(std::accumulate(force.begin(), force.end(), 0.0), 60, 0.1);
  for (const double foot : force) EXPECT_NEAR(foot, 15, 0.1);
}

TEST_F(WorldTest, HasNoForceOnItsFeetInTheAir) {
  world_.robot().Reset({.q = spec_.standing.q, .height = 2});
  HoldFor(1, spec_.standing.q);
  std::vector<double> force(4, -1.0);
  world_.robot().FootForces(force);
  EXPECT_EQ(force, std::vector<double>(4, 0.0));
}

TEST_F(WorldTest, ReadingsKeepTheirInstantUntilTheNextStepBegins) {
  world_.robot().Reset({.q = spec_.standing.q, .height = 2});
  HoldFor(10, spec_.standing.q);
  world_.BeginStep();
  const double height = world_.robot().base().p_WB.z();
  const double rate = world_.robot().base().v_WB_W.z();
  const PointReading hook = world_.Point(world_.robot().Body("base"), {0, 0, 0.1});
  world_.robot().Drive(std::vector<double>(6, 1.0));
  ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  EXPECT_EQ(world_.robot().base().p_WB.z(), height);
  EXPECT_EQ(world_.robot().base().v_WB_W.z(), rate);
  EXPECT_EQ(world_.Point(world_.robot().Body("base"), {0, 0, 0.1}).p_WP, hook.p_WP);
  world_.BeginStep();
  EXPECT_LT(world_.robot().base().p_WB.z(), height);
}

// A foot of a swinging leg on a falling, turning trunk: velocity against the difference of
// positions.
TEST_F(WorldTest, PointVelocityIsTheDerivativeOfItsPosition) {
  world_.robot().Reset({.q = spec_.standing.q, .height = 5});
  const int leg = world_.robot().Body("FL_leg");
  const Eigen::Vector3d foot(0, 0, -0.28);
  for (int i = 0; i < 100; ++i) {
    world_.BeginStep();
    world_.robot().Drive(std::vector{0.5, 2.0, -0.5, 0.0, 0.1, 0.2});
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  }
  world_.BeginStep();
  const PointReading before = world_.Point(leg, foot);
  world_.robot().Drive(std::vector<double>(6, 0.0));
  ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  world_.BeginStep();
  const PointReading after = world_.Point(leg, foot);
  const Eigen::Vector3d difference = (after.p_WP - before.p_WP) / world_.timestep();
  EXPECT_GT(before.v_WP_W.norm(), 1);
  EXPECT_LT((difference - (before.v_WP_W + after.v_WP_W) / 2).norm(), 0.02);
  world_.robot().Drive(std::vector<double>(6, 0.0));
  EXPECT_EQ(world_.EndStep(), StepHealth::kFine);
}

TEST_F(WorldTest, ClampHoldsTheBaseWhereItIs) {
  world_.robot().Reset({.q = spec_.hanging.q, .height = 1});
  world_.robot().Clamp(true);
  EXPECT_TRUE(world_.robot().clamped());
  for (int i = 0; i < 2000; ++i) {
    world_.BeginStep();
    world_.robot().Drive(test::Hold(world_.robot(), spec_.hanging.q));
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
    ASSERT_LT((world_.robot().base().p_WB - Eigen::Vector3d(0, 0, 1)).norm(), 0.001) << i;
    ASSERT_LT(world_.robot().tilt(), 0.001) << i;
  }
  EXPECT_LT((world_.robot().Imu().f_WI_I - Eigen::Vector3d(0, 0, 10)).norm(), 0.01);
}

TEST_F(WorldTest, ClampHoldsATurnedBaseToo) {
  world_.robot().Reset({.q = spec_.hanging.q, .height = 3});
  const int base = world_.robot().Body("base");
  for (int i = 0; i < 200; ++i) {  // a push off its centre turns it
    world_.BeginStep();
    world_.AddForce(base, world_.Point(base, {0, 0.3, 0}).p_WP, {3, 0, 20});
    world_.robot().Drive(test::Hold(world_.robot(), spec_.hanging.q));
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  }
  world_.robot().Clamp(true);
  world_.BeginStep();
  const Eigen::Vector3d place = world_.robot().base().p_WB;
  const Eigen::Quaterniond attitude = world_.robot().Imu().R_WI;
  ASSERT_GT(world_.robot().tilt(), 0.1);
  world_.robot().Drive(test::Hold(world_.robot(), spec_.hanging.q));
  ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  HoldFor(2000, spec_.hanging.q);
  EXPECT_LT((world_.robot().base().p_WB - place).norm(), 0.001);
  EXPECT_LT(world_.robot().Imu().R_WI.angularDistance(attitude), 0.001);
}

TEST_F(WorldTest, ClampStandsAgainstItsMotors) {
  world_.robot().Reset({.q = spec_.hanging.q, .height = 1});
  world_.robot().Clamp(true);
  for (int i = 0; i < 1000; ++i) {
    world_.BeginStep();
    const double tau = 20 * std::sin(0.02 * i);
    world_.robot().Drive(std::vector{tau, tau, tau, tau, 0.0, 0.0});
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
    ASSERT_LT((world_.robot().base().p_WB - Eigen::Vector3d(0, 0, 1)).norm(), 0.005) << i;
  }
}

TEST_F(WorldTest, FallsWhenTheClampLetsGo) {
  world_.robot().Reset({.q = spec_.hanging.q, .height = 5});
  world_.robot().Clamp(true);
  HoldFor(100, spec_.hanging.q);
  world_.robot().Clamp(false);
  EXPECT_FALSE(world_.robot().clamped());
  HoldFor(500, spec_.hanging.q);
  EXPECT_NEAR(world_.robot().base().p_WB.z(), 3.75, 0.01);  // 10 / 2 · 0.5²
}

TEST_F(WorldTest, LetsGoOnReset) {
  world_.robot().Clamp(true);
  world_.robot().Reset({.q = spec_.hanging.q, .height = 1});
  EXPECT_FALSE(world_.robot().clamped());
}

TEST_F(WorldTest, HasADefaultReadingWhereThereIsNoSecondUnit) {
  robot::RobotSpec spec = spec_;
  spec.imu.secondary_site.clear();
  MujocoWorld world = test::FixtureWorld(spec);
  world.robot().Reset({.q = spec.standing.q, .height = 1});
  EXPECT_EQ(world.robot().SecondaryImu().f_WI_I, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(world.robot().SecondaryImu().R_WI.w(), 1);
}

TEST_F(WorldTest, MovesOnInAnotherOwner) {
  world_.robot().Reset({.q = spec_.standing.q, .height = 2});
  const MujocoWorld moved = std::move(world_);
  EXPECT_EQ(moved.robot().base().p_WB.z(), 2);
  EXPECT_EQ(moved.robot().q().size(), 6U);
}

}  // namespace
}  // namespace understudy::physics
