#include <limits>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

class DivergenceTest : public test::MujocoTest {
 protected:
  DivergenceTest() { std::filesystem::current_path(folder_.path()); }
  ~DivergenceTest() override { std::filesystem::current_path(before_); }

  StepHealth Step(double tau) {
    world_.BeginStep();
    world_.robot().Drive(std::vector<double>(6, tau));
    return world_.EndStep();
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path before_ = std::filesystem::current_path();
  MujocoWorld world_ = test::FixtureWorld();
};

TEST_F(DivergenceTest, IsReportedForAnAccelerationBeyondReason) {
  world_.robot().Reset({.q = test::FixtureRobot().hanging.q, .height = 5});
  ASSERT_EQ(Step(0), StepHealth::kFine);
  EXPECT_EQ(Step(1e30), StepHealth::kDiverged);
  EXPECT_NE(mjcf::TakeMujocoWarning(), "");
}

TEST_F(DivergenceTest, IsReportedForATorqueThatIsNoNumber) {
  world_.robot().Reset({.q = test::FixtureRobot().hanging.q, .height = 5});
  EXPECT_EQ(Step(std::numeric_limits<double>::quiet_NaN()), StepHealth::kDiverged);
  EXPECT_NE(mjcf::TakeMujocoWarning(), "");
}

// What MuJoCo does by itself: its clock is back at 0 and the robot where the file has it.
TEST_F(DivergenceTest, MakesMujocosSilentResetVisible) {
  world_.robot().Reset({.q = test::FixtureRobot().hanging.q, .height = 5});
  for (int i = 0; i < 100; ++i) ASSERT_EQ(Step(0), StepHealth::kFine);
  ASSERT_NEAR(world_.data().time, 0.1, 1e-9);
  EXPECT_EQ(Step(1e30), StepHealth::kDiverged);
  EXPECT_LT(world_.data().time, 0.01);
  EXPECT_NE(mjcf::TakeMujocoWarning(), "");
}

// The rate passes MuJoCo's bound of 1e10 between two steps: the first half of the next one finds
// it and resets; the second half must tell.
TEST_F(DivergenceTest, IsReportedWhenTheFirstHalfOfTheStepFindsIt) {
  world_.robot().Reset({.q = test::FixtureRobot().hanging.q, .height = 5});
  const int base = world_.robot().Body("base");
  const std::vector<double> none(6, 0.0);
  StepHealth health = StepHealth::kFine;
  int steps = 0;
  for (; steps < 5000 && health == StepHealth::kFine; ++steps) {
    world_.BeginStep();
    world_.AddForce(base, world_.Point(base, {0, 0, 0}).p_WP, {0, 0, 3e10});
    world_.robot().Drive(none);
    health = world_.EndStep();
  }
  EXPECT_EQ(health, StepHealth::kDiverged);
  EXPECT_GT(steps, 1);
  EXPECT_NE(mjcf::TakeMujocoWarning(), "");
}

TEST_F(DivergenceTest, IsOverAfterAReset) {
  const robot::RobotSpec spec = test::FixtureRobot();
  world_.robot().Reset({.q = spec.standing.q, .height = spec.standing.height});
  ASSERT_EQ(Step(1e30), StepHealth::kDiverged);
  world_.robot().Reset({.q = spec.standing.q, .height = spec.standing.height});
  for (int i = 0; i < 100; ++i) {
    world_.BeginStep();
    world_.robot().Drive(test::Hold(world_.robot(), spec.standing.q));
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  }
  EXPECT_NEAR(world_.robot().base().p_WB.z(), 0.3, 0.01);
  EXPECT_NE(mjcf::TakeMujocoWarning(), "");
}

TEST_F(DivergenceTest, IsReportedAgainWhenItHappensAgain) {
  for (int i = 0; i < 3; ++i) {
    world_.robot().Reset({.q = test::FixtureRobot().hanging.q, .height = 5});
    EXPECT_EQ(Step(1e30), StepHealth::kDiverged);
    EXPECT_NE(mjcf::TakeMujocoWarning(), "") << i;
  }
}

TEST_F(DivergenceTest, WritesNoLogFile) {
  world_.robot().Reset({.q = test::FixtureRobot().hanging.q, .height = 5});
  ASSERT_EQ(Step(1e30), StepHealth::kDiverged);
  EXPECT_NE(mjcf::TakeMujocoWarning(), "");
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

}  // namespace
}  // namespace understudy::physics
