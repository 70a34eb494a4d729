// What programs compute from a sleep to their next message.
#include <memory>

#include <gmock/gmock.h>

#include "own_clock.h"
#include "simclock/own_page.h"

namespace understudy::simclock {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

TEST(ComputedTest, ASpanIsASixteenthWide) {
  for (std::int64_t ns = 0; ns < 1'000'000'000'000; ns = ns * 9 / 8 + 1) {
    const std::int64_t least = LeastOf(SpanOf(ns));
    ASSERT_LE(least, ns);
    ASSERT_GT(least, ns - ns / 16 - 1);
    ASSERT_EQ(SpanOf(least), SpanOf(ns));
  }
  EXPECT_EQ(SpanOf(-5), 0U);
  EXPECT_LT(SpanOf(INT64_MAX), kSpans);
}

TEST(ComputedTest, TheMedianIsOfAllTimes) {
  const auto page = std::make_unique<Page>();
  EXPECT_EQ(MedianComputed(*page), std::nullopt);
  page->computed[SpanOf(1000)] = 4;
  page->computed[SpanOf(4096)] = 5;
  page->computed[SpanOf(1'000'000)] = 1;
  EXPECT_EQ(MedianComputed(*page), nanoseconds(4096));
}

TEST(ComputedTest, ProgramsAreMeasuredByTheProcessorsTime) {
  const test::ClockedRun run = test::RunOnClock({UNDERSTUDY_WAITS, "computes"});
  ASSERT_TRUE(run.computed);
  EXPECT_GT(*run.computed, milliseconds(4));
  EXPECT_LT(*run.computed, milliseconds(50));
  EXPECT_NEAR(run.simulated, 0.05, 0.002);  // and take no simulated time
}

TEST(ComputedTest, AProgramThatOnlySleepsComputesNothing) {
  EXPECT_EQ(test::RunOnClock({"/bin/sleep", "1"}).computed, std::nullopt);
}

}  // namespace
}  // namespace understudy::simclock
