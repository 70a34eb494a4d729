#include "identify/excitation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/robots.h"

namespace understudy::identify {
namespace {

constexpr double kStep = 0.002;

class ExcitationTest : public testing::Test {
 protected:
  const robot::RobotSpec& robot_ = test::ShippedRobot("go2");
  std::vector<std::array<double, 2>> ranges_ =
      std::vector<std::array<double, 2>>(robot_.motors.size(), {-3, 3});
  std::vector<double> q_ = std::vector<double>(robot_.motors.size(), 0.5);
};

TEST_F(ExcitationTest, LeavesAMarginOfEachRange) {
  ranges_[0] = {-0.2, 1};
  const Excitation program(robot_, {.amplitude = 1}, q_, ranges_);
  double least = 1, most = -1;
  for (double t = Excitation::kMove; t < program.seconds(); t += kStep) {
    const double q = program.At(t).motors[0].q;
    least = std::min(least, q);
    most = std::max(most, q);
  }
  EXPECT_GE(least, -0.2 + Excitation::kMargin - 1e-12);
  EXPECT_GT(most - least, 0.19);
}

TEST_F(ExcitationTest, BeginsWhereTheJointsAreAndNeverJumps) {
  const ExcitationSpec spec{.amplitude = 0.5, .from_hz = 0.5, .to_hz = 10, .seconds = 8};
  const Excitation program(robot_, spec, q_, ranges_);
  EXPECT_EQ(program.At(0).motors[1].q, q_[1]);
  for (double t = kStep; t < program.seconds(); t += kStep) {
    for (std::size_t i = 0; i < q_.size(); ++i) {
      const double was = program.At(t - kStep).motors[i].q;
      ASSERT_LT(std::abs(program.At(t).motors[i].q - was), 1.5 * Excitation::kMostSpeed * kStep)
          << t;
    }
  }
}

TEST_F(ExcitationTest, EndsInDampingThatComesSoftlyAlsoWhenItIsStopped) {
  const ExcitationSpec spec{.seconds = 5};
  const Excitation program(robot_, spec, q_, ranges_);
  EXPECT_EQ(program.At(program.seconds()).motors[0].kp, 0);
  EXPECT_EQ(program.At(program.seconds()).motors[0].kd, spec.kd);
  const double stopped = 5.1;
  double kp = program.At(stopped, stopped).motors[3].kp;
  EXPECT_EQ(kp, spec.kp);
  for (double t = stopped; t < stopped + Excitation::kSoften + kStep; t += kStep) {
    const robot::MotorCommand now = program.At(t, stopped).motors[3];
    EXPECT_EQ(now.q, program.At(stopped).motors[3].q);
    ASSERT_LT(kp - now.kp, 0.1 * spec.kp);
    kp = now.kp;
  }
  EXPECT_EQ(kp, 0);
}

TEST_F(ExcitationTest, MovesOnlyTheChosenJoints) {
  const Excitation program(robot_, {.motors = {4}}, q_, ranges_);
  const double t = Excitation::kMove + 7.3;
  EXPECT_EQ(program.At(t).motors[0].q, robot_.hanging.q[0]);
  EXPECT_NE(program.At(t).motors[4].q, robot_.hanging.q[4]);
}

}  // namespace
}  // namespace understudy::identify
