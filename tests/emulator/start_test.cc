#include <numeric>

#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

class StartTest : public EmulatorTest {};

TEST_F(StartTest, DampedLiesWhereItIsPut) {
  StartAs("lying");
  EXPECT_EQ(Height(), config_.robots[0].spec.lying.height);
  Tick(3000);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kStart);
  EXPECT_NEAR(Height(), 0.05, 0.01);  // on its trunk
  EXPECT_LT(world_->status(0).tilt, 0.05);
  for (const double rate : world_->physics().robot().dq()) EXPECT_NEAR(rate, 0, 0.01);
  for (const robot::MotorReading& motor : port_.last().state.motors) EXPECT_TRUE(motor.enabled);
}

TEST_F(StartTest, StandingHoldsItsPose) {
  StartAs("standing");
  for (int i = 0; i < 3000; ++i) {
    Tick();
    ASSERT_NEAR(Height(), 0.3, 0.005) << i;
    ASSERT_LT(world_->status(0).tilt, 0.02) << i;
  }
  for (const double q : world_->physics().robot().q()) EXPECT_NEAR(q, 0, 0.01);
  const auto& force = port_.last().state.foot_force;
  EXPECT_NEAR(std::accumulate(force.begin(), force.end(), 0.0), 60, 0.5);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kStart);
}

TEST_F(StartTest, HangingHangsStillFromTheFirstStep) {
  StartAs("hanging");
  for (int i = 0; i < 3000; ++i) {
    Tick();
    ASSERT_NEAR(Height(), 1, 0.001) << i;
    ASSERT_NEAR(world_->status(0).crane_tension, 60, 0.5) << i;
  }
  EXPECT_TRUE(world_->status(0).crane_attached);
  EXPECT_FALSE(world_->status(0).clamped);
}

TEST_F(StartTest, ClampedStaysWhereItIs) {
  StartAs("clamped");
  for (int i = 0; i < 3000; ++i) {
    Tick();
    ASSERT_NEAR(Height(), 1, 0.001) << i;
    ASSERT_LT(world_->status(0).tilt, 0.001) << i;
  }
  EXPECT_TRUE(world_->status(0).clamped);
  EXPECT_FALSE(world_->status(0).crane_attached);
}

TEST_F(StartTest, IsTheRobotsOwnWhenNoneIsAskedFor) {
  config_.robots[0].spec.default_start = "clamped";
  StartAs("");
  EXPECT_TRUE(world_->status(0).clamped);
}

TEST_F(StartTest, IsTheOneAskedForBeforeTheRobotsOwn) {
  config_.robots[0].spec.default_start = "clamped";
  StartAs("standing");
  EXPECT_FALSE(world_->status(0).clamped);
  EXPECT_EQ(Height(), config_.robots[0].spec.standing.height);
}

TEST_F(StartTest, PutsEachJointWhereThePoseSays) {
  config_.robots[0].spec.hanging.q = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  StartAs("clamped");
  Tick();
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(port_.last().state.motors[i].q, config_.robots[0].spec.hanging.q[i]);
  }
}

TEST_F(StartTest, HasAStatusBeforeTheFirstTick) {
  StartAs("hanging");
  const Status status = world_->status(0);
  EXPECT_EQ(status.steps, 0);
  EXPECT_EQ(status.time, 0);
  EXPECT_EQ(status.published, 0U);
  EXPECT_EQ(status.base_height, 1);
  EXPECT_EQ(status.tilt, 0);
  EXPECT_EQ(status.gate, authority::GateState::kStart);
}

}  // namespace
}  // namespace understudy::emulator
