#include <gmock/gmock.h>

#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

class SamplesTest : public EmulatorTest {};

TEST_F(SamplesTest, AreTakenInTheStepsThatThePortAsksFor) {
  config_.physics.timestep = 0.0005;
  port_.TellEvery(4);
  Start();
  Tick(4000);  // two seconds
  EXPECT_NEAR(world_->time(), 2, 1e-9);
  ASSERT_EQ(port_.samples().size(), 1000U);
  EXPECT_EQ(world_->status(0).published, 1000U);
  for (std::int64_t i = 0; const test::FakePort::Sample& sample : port_.samples()) {
    EXPECT_EQ(sample.state.tick_ms, 2 * i++);
  }
}

TEST_F(SamplesTest, AreEachOfANewInstant) {
  port_.TellEvery(1);
  config_.robots[0].spec.lying.height = 5;  // it falls, so that height tells the time
  Start();
  Tick(500);
  ASSERT_EQ(port_.samples().size(), 500U);
  for (std::size_t i = 1; i < 500; ++i) {
    EXPECT_LT(port_.samples()[i].state.base.p_WB.z(), port_.samples()[i - 1].state.base.p_WB.z());
  }
}

// The first sample is of the start pose, untouched.
TEST_F(SamplesTest, BeginAtTheStart) {
  Start();
  Tick();
  ASSERT_EQ(port_.samples().size(), 1U);
  const test::FakePort::Sample& first = port_.last();
  EXPECT_EQ(first.state.tick_ms, 0);
  EXPECT_EQ(first.state.base.p_WB.z(), config_.robots[0].spec.lying.height);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(first.state.motors[i].q, config_.robots[0].spec.lying.q[i]);
    EXPECT_EQ(first.state.motors[i].dq, 0);
  }
}

TEST_F(SamplesTest, StopUnderSilenceWhileTheRobotMovesOn) {
  config_.robots[0].spec.lying.height = 5;
  Start();
  Tick(10);
  const std::size_t before = port_.samples().size();
  const double height = Height();
  robot().Silence(true);
  Tick(100);
  EXPECT_EQ(port_.samples().size(), before);
  EXPECT_LT(Height(), height - 0.05);
  EXPECT_TRUE(world_->status(0).silenced);
  EXPECT_EQ(world_->status(0).published, before);

  robot().Silence(false);
  Tick(10);
  EXPECT_EQ(port_.samples().size(), before + 5);
  EXPECT_EQ(port_.last().state.tick_ms, 118);
}

TEST_F(SamplesTest, StopUnderSilenceWhileCommandsAreTaken) {
  Start();
  robot().Silence(true);
  port_.Send(Torque(1));
  Tick();
  EXPECT_TRUE(port_.idle());
  EXPECT_EQ(world_->status(0).commands.accepted, 1U);
}

TEST_F(SamplesTest, AreTheMomentToTellOnceOfWhatThePortWentOnInSpiteOf) {
  Start();
  port_.Bring({.write_failures = 3, .unused_slot = true, .unset_head = true, .writers = 2});
  Tick(10);
  EXPECT_THAT(Told(EventKind::kWriteFailure),
              testing::ElementsAre(testing::HasSubstr("3 messages")));
  EXPECT_THAT(Told(EventKind::kUnusedSlot), testing::SizeIs(1));
  EXPECT_THAT(Told(EventKind::kUnsetHead), testing::SizeIs(1));
  EXPECT_THAT(Told(EventKind::kWriters), testing::ElementsAre(testing::HasSubstr("2 programs")));
}

}  // namespace
}  // namespace understudy::emulator
