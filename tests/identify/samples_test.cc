#include "identify/samples.h"

#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "identify/replay.h"

namespace understudy::identify {
namespace {

robot::RobotSpec TwoJoints() {
  robot::RobotSpec spec;
  spec.motors = {{.joint = "hip_joint", .slot = 0}, {.joint = "knee_joint", .slot = 1}};
  return spec;
}

Samples Csv(const std::string& text) {
  std::istringstream stream(text);
  return ReadCsv(stream, "a.csv", TwoJoints());
}

std::string Refusal(const std::string& text) {
  try {
    Csv(text);
  } catch (const RecordError& error) {
    return error.what();
  }
  return "";
}

TEST(CsvSamplesTest, TakeColumnsByJointAndGainsOfAll) {
  const Samples samples =
      Csv("time,hip.q,knee_joint.q,hip.q_des,knee.tau_ff,kp,note\r\n"
          "0,0.1,,0.2,3,20,x\r\n"
          "0.5,0.15,0.4,0.3,4,25,\r\n");
  EXPECT_THAT(samples.times, testing::ElementsAre(0, 0.5));
  EXPECT_EQ(samples.q(0, 1), 0.15);
  EXPECT_TRUE(std::isnan(samples.q(1, 0)));
  const robot::RobotCommand& second = samples.commands.at(1);
  EXPECT_EQ(second.motors.at(0), (robot::MotorCommand{.enabled = true, .q = 0.3, .kp = 25}));
  EXPECT_EQ(second.motors.at(1), (robot::MotorCommand{.enabled = true, .tau = 4, .kp = 25}));
}

TEST(CsvSamplesTest, AreRefusedWithTheLineThatIsWrong) {
  const std::string head = "time,hip.q,hip.q_des\n";
  EXPECT_EQ(Refusal(head + "0,1,2\n0,1,2\n"), "a.csv:3: the time does not grow");
  EXPECT_EQ(Refusal(head + "0,1\n"), "a.csv:2: expected 3 cells, got 2");
  EXPECT_EQ(Refusal(head + "0,one,2\n"), "a.csv:2: expected a number, got 'one'");
  EXPECT_EQ(Refusal(head + "0,nan,2\n"), "a.csv:2: expected a number, got 'nan'");
  EXPECT_EQ(Refusal(head), "a.csv: has no rows");
  EXPECT_THAT(Refusal("time,q\n0,1\n"), testing::HasSubstr("a.csv:1: expected columns time"));
}

TEST(MeanCommandTest, IsWhatHeldOnAverage) {
  Samples samples{.command_times = {0, 0.010}};
  for (const double q : {1.0, 2.0}) {
    samples.commands.push_back({.motors = {{.enabled = true, .q = q, .kp = 10}}});
  }
  std::size_t cursor = 0;
  EXPECT_EQ(MeanCommand(samples, 0.008, 0.010, &cursor).motors[0].q, 1);
  EXPECT_DOUBLE_EQ(MeanCommand(samples, 0.009, 0.013, &cursor).motors[0].q, 1.75);
  EXPECT_EQ(MeanCommand(samples, 0.012, 0.013, &cursor).motors[0].q, 2);
}

TEST(MeanCommandTest, DoesNotMixTheMarkForNoPosition) {
  Samples samples{.command_times = {0, 0.010}};
  for (const double q : {1.0, robot::kNoPosition}) {
    samples.commands.push_back({.motors = {{.enabled = true, .q = q}}});
  }
  std::size_t cursor = 0;
  EXPECT_EQ(MeanCommand(samples, 0.008, 0.011, &cursor).motors[0].q, 1);
}

TEST(StateAtTest, TakesTheRateOfHalfAStepBeforeFromAngles) {
  Samples samples;
  for (int i = 0; i < 50; ++i) samples.times.push_back(0.002 * i);
  samples.q.resize(1, 50);
  const auto angle = [](double t) { return 0.3 * std::sin(20 * t); };
  for (int i = 0; i < 50; ++i) samples.q(0, i) = angle(samples.times[static_cast<std::size_t>(i)]);
  for (const std::size_t i : {0u, 25u, 49u}) {
    const JointState state = StateAt(samples, i, 0.001);
    EXPECT_NEAR(state.q[0], angle(samples.times[i]), 1e-5);
    EXPECT_NEAR(state.dq[0], 6 * std::cos(20 * (samples.times[i] - 0.0005)), 0.01);
  }
}

TEST(IsAmongStatesTest, IsFalseAtTheEndsAndBesideAPause) {
  Samples samples;
  for (int i = 0; i < 50; ++i) samples.times.push_back(0.0021 * i + (i >= 25 ? 1 : 0));
  std::vector<std::size_t> among;
  for (std::size_t i = 0; i < samples.times.size(); ++i) {
    if (IsAmongStates(samples, i)) among.push_back(i);
  }
  std::vector<std::size_t> expected;
  for (std::size_t i = 5; i <= 19; ++i) expected.push_back(i);
  for (std::size_t i = 30; i <= 44; ++i) expected.push_back(i);
  EXPECT_EQ(among, expected);
}

TEST(WindowsOfTest, StartWhereTheRateIsKnownFromBothSides) {
  Samples samples;
  for (int i = 0; i < 100; ++i) samples.times.push_back(0.0021 * i);
  samples.q = Eigen::MatrixXd::Zero(1, 100);
  samples.command_times = {0};
  samples.commands = {{.motors = {{}}}};
  const std::vector<ReplayWindow> windows = WindowsOf(samples, 0.05, 0.001);
  ASSERT_EQ(windows.size(), 4U);
  EXPECT_EQ(windows[0].first, 5U);
  EXPECT_EQ(windows[1].first, 28U);
}

}  // namespace
}  // namespace understudy::identify
