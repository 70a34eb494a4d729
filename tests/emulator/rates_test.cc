#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

struct Rates {
  double timestep;     // s
  double lowstate_hz;  // of simulated time, like the others
  double motion_hz;
  double lf_hz;
};

class RatesTest : public EmulatorTest, public testing::WithParamInterface<Rates> {};

TEST_P(RatesTest, SendsEachMessageAtItsRateOfSimulatedTime) {
  const Rates& rates = GetParam();
  config_.physics.timestep = rates.timestep;
  config_.robot.rates = {
      .lowstate_hz = rates.lowstate_hz, .motion_hz = rates.motion_hz, .lf_hz = rates.lf_hz};
  Start();
  Tick(static_cast<int>(std::lround(2 / rates.timestep)));  // two seconds
  EXPECT_NEAR(world_->time(), 2, 1e-9);

  int lowstate = 0;
  int motion = 0;
  int lf = 0;
  std::int64_t next_tick_ms = 0;
  for (const test::FakePort::Sample& sample : port_.samples()) {
    EXPECT_TRUE(sample.due.any());
    if (sample.due.lowstate) {
      EXPECT_EQ(sample.state.tick_ms, next_tick_ms);
      next_tick_ms += std::lround(1000 / rates.lowstate_hz);
      ++lowstate;
    }
    if (sample.due.motion) ++motion;
    if (sample.due.lf) ++lf;
  }
  EXPECT_EQ(lowstate, std::lround(2 * rates.lowstate_hz));
  EXPECT_EQ(motion, std::lround(2 * rates.motion_hz));
  EXPECT_EQ(lf, std::lround(2 * rates.lf_hz));
  EXPECT_EQ(world_->status().published, static_cast<std::uint64_t>(lowstate));
}

INSTANTIATE_TEST_SUITE_P(Robots, RatesTest,
                         testing::Values(Rates{0.001, 500, 500, 20},       // as a Go2
                                         Rates{0.001, 1000, 500, 20},      // as a G1
                                         Rates{0.0005, 500, 250, 20},      // half a step of a ms
                                         Rates{0.002, 500, 100, 10},       // a coarse one
                                         Rates{0.0001, 1000, 1000, 100}),  // the finest
                         [](const auto& test) { return "Case" + std::to_string(test.index); });

class SamplesTest : public EmulatorTest {};

TEST_F(SamplesTest, AreEachOfANewInstant) {
  config_.robot.rates.lowstate_hz = 1000;
  config_.robot.lying.height = 5;  // it falls, so that height tells the time
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
  EXPECT_TRUE(first.due.lowstate && first.due.motion && first.due.lf);
  EXPECT_EQ(first.state.tick_ms, 0);
  EXPECT_EQ(first.state.base.p_WB.z(), config_.robot.lying.height);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(first.state.motors[i].q, config_.robot.lying.q[i]);
    EXPECT_EQ(first.state.motors[i].dq, 0);
  }
}

TEST_F(SamplesTest, StopUnderSilenceWhileTheRobotMovesOn) {
  config_.robot.lying.height = 5;
  Start();
  Tick(10);
  const std::size_t before = port_.samples().size();
  const double height = Height();
  robot().Silence(true);
  Tick(100);
  EXPECT_EQ(port_.samples().size(), before);
  EXPECT_LT(Height(), height - 0.05);
  EXPECT_TRUE(world_->status().silenced);
  EXPECT_EQ(world_->status().published, before);

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
  EXPECT_EQ(world_->status().commands.accepted, 1U);
}

}  // namespace
}  // namespace understudy::emulator
