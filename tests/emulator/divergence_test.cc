#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

// Motors that are told and able to tear the robot apart.
class EmulatorDivergenceTest : public EmulatorTest {
 protected:
  EmulatorDivergenceTest() {
    for (robot::MotorSpec& motor : config_.robots[0].spec.motors) {
      motor.torque_limit = 1e30;
      motor.type = "";
    }
    config_.robots[0].spec.battery.internal_ohm = 0;
    port_.TellEvery(1);
    config_.robots[0].start.pose = "standing";
  }

  void Diverge() {
    Tick(100);
    port_.Send(Torque(1e30));
    EXPECT_EQ(world_->Tick({}), physics::StepHealth::kDiverged);
    EXPECT_NE(mjcf::TakeMujocoWarning(), "");
  }
};

TEST_F(EmulatorDivergenceTest, IsReportedAndCounted) {
  Start();
  Diverge();
  EXPECT_EQ(world_->status(0).divergences, 1U);
}

TEST_F(EmulatorDivergenceTest, SendsNothingOfTheStep) {
  Start();
  Diverge();
  EXPECT_EQ(port_.samples().size(), 100U);
  EXPECT_EQ(port_.last().state.tick_ms, 99);
  EXPECT_EQ(world_->status(0).published, 100U);
}

TEST_F(EmulatorDivergenceTest, PutsTheRobotBackToItsStartWhileTimeGoesOn) {
  config_.physics.on_divergence = config::DivergenceAction::kReset;
  Start();
  Diverge();
  EXPECT_EQ(world_->step(), 101);
  EXPECT_EQ(Height(), config_.robots[0].spec.standing.height);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kStart);

  Tick(500);
  EXPECT_EQ(port_.samples()[100].state.tick_ms, 101);
  EXPECT_EQ(port_.last().state.tick_ms, 600);
  EXPECT_NEAR(Height(), config_.robots[0].spec.standing.height, 0.01);
  EXPECT_EQ(world_->status(0).divergences, 1U);
}

TEST_F(EmulatorDivergenceTest, HangsTheRobotUpAgain) {
  config_.physics.on_divergence = config::DivergenceAction::kReset;
  config_.robots[0].start.pose = "hanging";
  Start();
  Ask("crane.lower", 0.2);
  Diverge();
  EXPECT_TRUE(world_->status(0).crane_attached);
  Tick(500);
  EXPECT_NEAR(Height(), config_.robots[0].spec.hanging.height, 0.001);
}

TEST_F(EmulatorDivergenceTest, ClampsTheRobotAgain) {
  config_.physics.on_divergence = config::DivergenceAction::kReset;
  config_.robots[0].start.pose = "clamped";
  Start();
  Diverge();
  EXPECT_TRUE(world_->status(0).clamped);
  Tick(500);
  EXPECT_NEAR(Height(), config_.robots[0].spec.hanging.height, 0.001);
}

}  // namespace
}  // namespace understudy::emulator
