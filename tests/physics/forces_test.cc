#include "physics/forces.h"

#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::physics {
namespace {

// The fixture, 6 kg, in the air and let go.
class ForcesTest : public test::MujocoTest {
 protected:
  ForcesTest() { world_.robot().Reset(spec_.hanging); }

  // Steps with `forces`, from where the last ones ended.
  template <class Forces>
  void Step(Forces* forces, int times) {
    for (int i = 0; i < times; ++i) {
      world_.BeginStep();
      forces->Act(static_cast<double>(step_++) * world_.timestep(), &world_);
      world_.robot().Drive(std::vector<double>(spec_.motors.size()));
      ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
    }
    world_.BeginStep();  // so that readings are of now
  }
  Eigen::Vector3d Base() const { return world_.Point(base_, {0, 0, 0}).p_WP; }

  robot::RobotSpec spec_ = test::FixtureRobot();
  MujocoWorld world_ = test::FixtureWorld(spec_, 0.001);
  int base_ = world_.robot().Body("base");
  std::int64_t step_ = 0;
};

TEST_F(ForcesTest, APushActsInEachStepOfItsTime) {
  Pushes dut;
  ASSERT_TRUE(dut.Begin(base_, {1, 0, 0}, 0.003));
  for (const std::size_t acting : {1U, 1U, 1U, 0U}) {
    Step(&dut, 1);
    EXPECT_EQ(dut.forces().size(), acting);
  }
}

TEST_F(ForcesTest, ThereIsABoundToPushesAndToDrags) {
  Pushes pushes;
  for (std::size_t i = 0; i < Pushes::kMost; ++i) EXPECT_TRUE(pushes.Begin(base_, {1, 0, 0}, 1));
  EXPECT_FALSE(pushes.Begin(base_, {1, 0, 0}, 1));
  Drags drags;
  for (std::size_t i = 0; i < Drags::kMost; ++i) {
    EXPECT_TRUE(drags.Pull(static_cast<int>(i), {0, 0, 0}, {0, 0, 0}, 1));
  }
  EXPECT_FALSE(drags.Pull(static_cast<int>(Drags::kMost), {0, 0, 0}, {0, 0, 0}, 1));
  EXPECT_TRUE(drags.Pull(0, {0, 0, 0}, {0, 0, 1}, 1));  // renewed, not one more
}

// Carried by the spring it hangs g / 100 m below where it is pulled to, and comes to rest there
// within the second that critical damping at 10 rad/s takes.
TEST_F(ForcesTest, ADragCarriesTheRobotToItsTarget) {
  Drags dut;
  const Eigen::Vector3d target = Base() + Eigen::Vector3d(0.1, -0.05, 0.2);
  ASSERT_TRUE(dut.Pull(base_, {0, 0, 0}, target, 10));
  Step(&dut, 1500);
  EXPECT_NEAR(Base().x(), target.x(), 0.02);
  EXPECT_NEAR(Base().y(), target.y(), 0.02);
  EXPECT_NEAR(Base().z(), target.z() - 0.1, 0.02);
  EXPECT_NEAR(world_.Point(base_, {0, 0, 0}).v_WP_W.norm(), 0, 0.05);
}

TEST_F(ForcesTest, ADragNeverPullsHarderThanFiveTimesTheWeight) {
  Drags dut;
  ASSERT_TRUE(dut.Pull(base_, {0, 0, 0}, {1e6, 0, 0}, 10));
  Step(&dut, 1);
  EXPECT_NEAR(dut.forces()[0].force_W.norm(), world_.SubtreeMass(base_) * 50, 1e-6);
}

TEST_F(ForcesTest, ADragOfALimbHasTheMassOfTheLimb) {
  Drags dut;
  const int leg = world_.robot().Body("FR_leg");
  ASSERT_TRUE(dut.Pull(leg, {0, 0, 0}, {1e6, 0, 0}, 10));
  Step(&dut, 1);
  EXPECT_LT(world_.SubtreeMass(leg), world_.SubtreeMass(base_) / 2);
  EXPECT_NEAR(dut.forces()[0].force_W.norm(), world_.SubtreeMass(leg) * 50, 1e-6);
}

TEST_F(ForcesTest, ADragEndsUnlessItIsRenewedOrWhenItIsReleased) {
  Drags dut;
  ASSERT_TRUE(dut.Pull(base_, {0, 0, 0}, Base(), 0.01));
  Step(&dut, 5);
  ASSERT_TRUE(dut.Pull(base_, {0, 0, 0}, Base(), 0.015));
  Step(&dut, 10);
  EXPECT_EQ(dut.forces().size(), 1U);
  Step(&dut, 1);
  EXPECT_EQ(dut.forces().size(), 0U);

  ASSERT_TRUE(dut.Pull(base_, {0, 0, 0}, Base(), 100));
  dut.Release(base_);
  Step(&dut, 1);
  EXPECT_EQ(dut.forces().size(), 0U);
}

TEST_F(ForcesTest, TwoBodiesAreDraggedEachItsOwnWay) {
  Drags dut;
  ASSERT_TRUE(dut.Pull(base_, {0, 0, 0}, {1e3, 0, 1}, 1));
  ASSERT_TRUE(dut.Pull(world_.robot().Body("FR_leg"), {0, 0, 0}, {-1e3, 0, 1}, 1));
  Step(&dut, 1);
  ASSERT_EQ(dut.forces().size(), 2U);
  EXPECT_GT(dut.forces()[0].force_W.x(), 0);
  EXPECT_LT(dut.forces()[1].force_W.x(), 0);
}

}  // namespace
}  // namespace understudy::physics
