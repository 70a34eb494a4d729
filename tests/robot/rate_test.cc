#include "robot/rate.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

std::vector<std::int64_t> DueSteps(const Rate& rate, std::int64_t steps) {
  std::vector<std::int64_t> due;
  for (std::int64_t step = 0; step < steps; ++step) {
    if (rate.Due(step)) due.push_back(step);
  }
  return due;
}

TEST(RateTest, IsDueAtTheStartAndThenAfterEveryPeriod) {
  EXPECT_EQ(DueSteps(Rate(500, 0.001), 7), (std::vector<std::int64_t>{0, 2, 4, 6}));
  EXPECT_EQ(DueSteps(Rate(20, 0.0005), 250), (std::vector<std::int64_t>{0, 100, 200}));
  EXPECT_EQ(DueSteps(Rate(1000.0 / 3, 0.001), 8), (std::vector<std::int64_t>{0, 3, 6}));
}

TEST(RateTest, KeepsItsMeanWhereAPeriodIsNoWholeNumberOfSteps) {
  EXPECT_EQ(DueSteps(Rate(300, 0.001), 11), (std::vector<std::int64_t>{0, 4, 7, 10}));
  for (const double hz : {300.0, 333.0, 41.7, 999.0}) {
    const auto due = static_cast<double>(DueSteps(Rate(hz, 0.001), 100'000).size());
    EXPECT_NEAR(due, 100 * hz, 1) << hz;
  }
}

TEST(RateTest, IsNotLateAndNotEarlyByAStep) {
  const Rate rate(300, 0.001);
  std::int64_t period = 0;
  for (const std::int64_t step : DueSteps(rate, 1'000'000)) {
    const double wanted = static_cast<double>(period++) / 0.3;
    EXPECT_GE(static_cast<double>(step), wanted - 1e-6);
    EXPECT_LT(static_cast<double>(step), wanted + 1);
  }
}

TEST(RateTest, IsDueInEveryStepAtMost) { EXPECT_EQ(DueSteps(Rate(5000, 0.001), 5).size(), 5U); }

TEST(RateTest, HoldsAfterAYear) {
  const Rate rate(300, 0.001);
  constexpr std::int64_t kYear = 365LL * 86'400 * 1000;
  int due = 0;
  for (std::int64_t step = kYear; step < kYear + 10'000; ++step) due += rate.Due(step) ? 1 : 0;
  EXPECT_EQ(due, 3000);
}

}  // namespace
}  // namespace understudy::robot
