#include "time/clock.h"

#include <gtest/gtest.h>

#include "tests/support/manual_clock.h"

namespace understudy::time {
namespace {

using namespace std::chrono_literals;  // NOLINT(google-build-using-namespace): 10ms reads best

TEST(ManualClockTest, StandsStillUntilTold) {
  test::ManualClock clock;
  EXPECT_EQ(clock.Now(), 0ns);
  EXPECT_EQ(clock.Now(), 0ns);
  clock.Advance(3ms);
  EXPECT_EQ(clock.Now(), 3ms);
}

TEST(ManualClockTest, SleepsToTheDeadlineAndNeverBack) {
  test::ManualClock clock;
  clock.SleepUntil(5ms);
  EXPECT_EQ(clock.Now(), 5ms);
  clock.SleepUntil(2ms);
  EXPECT_EQ(clock.Now(), 5ms);
}

TEST(SteadyClockTest, NeverGoesBack) {
  SteadyClock clock;
  const Clock::Time first = clock.Now();
  const Clock::Time second = clock.Now();
  EXPECT_GT(first, 0ns);
  EXPECT_GE(second, first);
}

TEST(SteadyClockTest, ReturnsAtTheDeadlineOrLater) {
  SteadyClock clock;
  const Clock::Time deadline = clock.Now() + 2ms;
  clock.SleepUntil(deadline);
  EXPECT_GE(clock.Now(), deadline);
}

TEST(SteadyClockTest, ReturnsAtOnceWhenTheDeadlineHasPassed) {
  SteadyClock clock;
  clock.SleepUntil(0ns);
  clock.SleepUntil(clock.Now() - 1h);
}

}  // namespace
}  // namespace understudy::time
