#include "time/pacer.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/manual_clock.h"

namespace understudy::time {
namespace {

using namespace std::chrono_literals;  // NOLINT(google-build-using-namespace): 10ms reads best

// Steps of 10 ms.
constexpr Clock::Time kPeriod = 10ms;

// One tick: how long the work before it took, and where WaitFor must leave the wall clock.
struct Row {
  Clock::Time work;      // of the step before
  std::int64_t step;     // that is waited for
  Clock::Time wall;      // when it begins
  Clock::Time lateness;  // behind its deadline
  std::uint64_t overruns;
};

void CheckPace(double speed, const std::vector<Row>& rows) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, speed);
  for (const Row& row : rows) {
    SCOPED_TRACE(testing::Message() << "step " << row.step);
    clock.Advance(row.work);
    const std::uint64_t before = pacer.reading().overruns;
    const Wait wait = pacer.WaitFor(row.step);
    const double lateness = std::chrono::duration<double>(row.lateness).count();
    EXPECT_EQ(clock.Now(), row.wall);
    EXPECT_NEAR(pacer.reading().lateness, lateness, 1e-12);
    EXPECT_EQ(pacer.reading().overruns, row.overruns);
    EXPECT_NEAR(wait.overrun, row.overruns > before ? lateness : 0, 1e-12);
  }
}

TEST(PacerTest, BeginsEachStepAtItsDeadline) {
  CheckPace(1, {
                   //  work  step  wall  lateness  overruns
                   {0ms, 0, 0ms, 0ms, 0},   // step 0 is due at once
                   {3ms, 1, 10ms, 0ms, 0},  // sleeps for the other 7 ms
                   {0ms, 2, 20ms, 0ms, 0},
                   {10ms, 3, 30ms, 0ms, 0},  // reaches the deadline to the nanosecond
               });
}

TEST(PacerTest, MakesUpForALateStepAndDropsNone) {
  CheckPace(1, {
                   //  work  step  wall  lateness  overruns
                   {0ms, 0, 0ms, 0ms, 0},
                   {16ms, 1, 16ms, 6ms, 0},   // less than a period late: no overrun
                   {1ms, 2, 20ms, 0ms, 0},    // on time again, no shift of the deadlines
                   {45ms, 3, 65ms, 35ms, 1},  // a stall of 35 ms
                   {1ms, 4, 66ms, 26ms, 2},   // the deadlines are the old ones: 40, 50, 60 ...
                   {1ms, 5, 67ms, 17ms, 3},
                   {1ms, 6, 68ms, 8ms, 3},
                   {1ms, 7, 70ms, 0ms, 3},  // caught up with
                   {1ms, 8, 80ms, 0ms, 3},
               });
}

TEST(PacerTest, MakesUpForAStallOfTheMostThatIsMadeUpFor) {
  CheckPace(1, {
                   //  work  step  wall  lateness  overruns
                   {0ms, 0, 0ms, 0ms, 0},
                   {kMostMadeUp + 10ms, 1, 210ms, 200ms, 1},
                   {1ms, 2, 211ms, 191ms, 2},  // the deadlines are the old ones
               });
}

TEST(PacerTest, CountsFromTheStepThatALongerStallEndedAt) {
  CheckPace(1, {
                   //  work  step  wall  lateness  overruns
                   {0ms, 0, 0ms, 0ms, 0},
                   {kMostMadeUp + 11ms, 1, 211ms, 201ms, 1},
                   {1ms, 2, 221ms, 0ms, 1},  // a period after step 1
                   {1ms, 3, 231ms, 0ms, 1},
                   {3600s, 4, 3600231ms, 3599990ms, 2},
                   {12ms, 5, 3600243ms, 2ms, 2},  // what is late is late for the moved deadline
                   {0ms, 6, 3600251ms, 0ms, 2},
               });
}

TEST(PacerTest, CountsWhatItDoesNotMakeUpFor) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 1);
  clock.Advance(kMostMadeUp + 10ms);
  EXPECT_EQ(pacer.WaitFor(1).shift, 0);
  EXPECT_EQ(pacer.reading().shifts, 0U);
  clock.Advance(5s);
  EXPECT_NEAR(pacer.WaitFor(2).shift, 5.19, 1e-12);  // due at 20 ms, reached at 5.21 s
  clock.Advance(1s + kPeriod);
  EXPECT_NEAR(pacer.WaitFor(3).shift, 1, 1e-12);
  EXPECT_EQ(pacer.reading().shifts, 2U);
  EXPECT_NEAR(pacer.reading().shifted, 6.19, 1e-12);
  EXPECT_NEAR(pacer.reading().worst_lateness, 5.19, 1e-12);
}

TEST(PacerTest, IsNeverFurtherBehindOnAMachineThatIsTooSlow) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 1);
  for (std::int64_t step = 0; step < 1000; ++step) {  // a step of 10 ms costs 15
    pacer.WaitFor(step);
    EXPECT_LE(pacer.reading().lateness, 0.205);
    clock.Advance(15ms);
  }
  EXPECT_GT(pacer.reading().shifts, 20U);
  const Clock::Time before = clock.Now();
  for (std::int64_t step = 1000; step < 1100; ++step) pacer.WaitFor(step);  // now it costs nothing
  EXPECT_GE(clock.Now() - before, 1000ms - kMostMadeUp - kPeriod);
}

TEST(PacerTest, CountsAnOverrunOnlyBeyondOnePeriod) {
  CheckPace(1, {
                   {0ms, 0, 0ms, 0ms, 0},
                   {20ms, 1, 20ms, 10ms, 0},  // one period late
                   {20ms + 1ns, 2, 40ms + 1ns, 20ms + 1ns, 1},
               });
}

TEST(PacerTest, HalvesThePeriodAtDoubleSpeed) {
  CheckPace(2, {
                   {0ms, 0, 0ms, 0ms, 0},
                   {0ms, 1, 5ms, 0ms, 0},
                   {0ms, 2, 10ms, 0ms, 0},
                   {11ms, 3, 21ms, 6ms, 1},  // 6 ms are more than 5
               });
}

TEST(PacerTest, DoublesThePeriodAtHalfSpeed) {
  CheckPace(0.5, {
                     {0ms, 0, 0ms, 0ms, 0},
                     {0ms, 1, 20ms, 0ms, 0},
                     {35ms, 2, 55ms, 15ms, 0},  // 15 ms are less than 20
                 });
}

// Steps of a third of a millisecond: rounded one by one they would be 0.1 ms off after 100 s.
TEST(PacerTest, DoesNotDriftWhenThePeriodIsNoWholeNumberOfNanoseconds) {
  test::ManualClock clock;
  Pacer pacer(&clock, 1ms, 3);
  for (std::int64_t step = 0; step <= 300'000; ++step) pacer.WaitFor(step);
  EXPECT_EQ(clock.Now(), 100s);
}

TEST(PacerTest, NeverSleepsAtSpeedZero) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 0);
  for (std::int64_t step = 0; step < 1000; ++step) pacer.WaitFor(step);
  EXPECT_EQ(clock.Now(), 0ms);
  EXPECT_EQ(pacer.reading().lateness, 0);
  EXPECT_EQ(pacer.reading().overruns, 0U);
}

TEST(PacerTest, RemembersTheWorstLateness) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 1);
  pacer.WaitFor(0);
  clock.Advance(40ms);
  pacer.WaitFor(1);
  pacer.WaitFor(10);
  EXPECT_EQ(pacer.reading().lateness, 0);
  EXPECT_NEAR(pacer.reading().worst_lateness, 0.030, 1e-12);
}

TEST(PacerTest, CountsFromItsOwnBirthNotFromTheClocks) {
  test::ManualClock clock;
  clock.Advance(77s);
  Pacer pacer(&clock, kPeriod, 1);
  pacer.WaitFor(1);
  EXPECT_EQ(clock.Now(), 77s + 10ms);
}

TEST(PacerTest, ForgetsAPauseOnResume) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 1);
  pacer.WaitFor(0);
  clock.Advance(60s);  // the pause
  pacer.Resume(1, 1);
  pacer.WaitFor(1);  // due at once
  EXPECT_EQ(clock.Now(), 60s);
  pacer.WaitFor(2);
  EXPECT_EQ(clock.Now(), 60s + 10ms);
  EXPECT_EQ(pacer.reading().overruns, 0U);
  EXPECT_EQ(pacer.reading().lateness, 0);
}

TEST(PacerTest, TakesANewSpeedOnResume) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 1);
  pacer.Resume(5, 10);
  EXPECT_EQ(pacer.speed(), 10);
  pacer.WaitFor(15);
  EXPECT_EQ(clock.Now(), 10ms);
}

TEST(PacerTest, KeepsItsCountsOnResume) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 1);
  clock.Advance(100ms);
  pacer.WaitFor(1);
  pacer.Resume(2, 1);
  EXPECT_EQ(pacer.reading().overruns, 1U);
  EXPECT_NEAR(pacer.reading().worst_lateness, 0.090, 1e-12);
}

TEST(PacerTest, HasNoRealTimeFactorBeforeASecondHasPassed) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 1);
  for (std::int64_t step = 0; step < 100; ++step) pacer.WaitFor(step);
  EXPECT_EQ(pacer.reading().real_time_factor, 0);
  pacer.WaitFor(100);
  EXPECT_NEAR(pacer.reading().real_time_factor, 1, 1e-12);
}

TEST(PacerTest, MeasuresTheRealTimeFactorOfTheLastSecond) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 0);
  std::int64_t step = 0;
  for (; step < 250; ++step) {  // a step of 10 ms costs 20 ms of wall time
    clock.Advance(20ms);
    pacer.WaitFor(step + 1);
  }
  EXPECT_NEAR(pacer.reading().real_time_factor, 0.5, 1e-12);
  for (; step < 1500; ++step) {  // now it costs 2 ms
    clock.Advance(2ms);
    pacer.WaitFor(step + 1);
  }
  EXPECT_NEAR(pacer.reading().real_time_factor, 5, 1e-12);
}

TEST(PacerTest, WaitsNoLongerThanItIsToldForAStepThatIsFarOff) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 0.1);  // 100 ms a step
  EXPECT_TRUE(pacer.WaitFor(0, 30ms).due);
  for (const Clock::Time wall : {30ms, 60ms, 90ms}) {
    EXPECT_FALSE(pacer.WaitFor(1, 30ms).due);
    EXPECT_EQ(clock.Now(), wall);
  }
  EXPECT_TRUE(pacer.WaitFor(1, 30ms).due);
  EXPECT_EQ(clock.Now(), 100ms);
}

// Steps while paused are made at the pace that is set, and what passed in between is no lateness.
TEST(PacerTest, HoldsAStepThatIsNotLateAfterwards) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 1);
  pacer.WaitFor(0);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(pacer.Hold(1, 2ms).due);
  EXPECT_EQ(clock.Now(), 200ms);
  EXPECT_TRUE(pacer.WaitFor(1).due);
  EXPECT_EQ(clock.Now(), 200ms);
  EXPECT_EQ(pacer.reading().overruns, 0U);
  pacer.WaitFor(2);
  EXPECT_EQ(clock.Now(), 210ms);
}

TEST(PacerTest, FollowsAPauseWithoutABurstOrAnOverrun) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 1);
  Pace pace;
  EXPECT_TRUE(pacer.WaitFor(pace, 0, 2s).due);
  EXPECT_TRUE(pacer.WaitFor(pace, 1, 2s).due);
  pace.paused = true;
  EXPECT_FALSE(pacer.WaitFor(pace, 2, 2s).due);
  EXPECT_FALSE(pacer.WaitFor(pace, 2, 2s).due);
  EXPECT_EQ(clock.Now(), 4010ms);
  EXPECT_EQ(pacer.reading().real_time_factor, 0);

  pace.steps_left = 2;
  EXPECT_TRUE(pacer.WaitFor(pace, 2, 2s).due);
  EXPECT_TRUE(pacer.WaitFor(pace, 3, 2s).due);
  EXPECT_EQ(clock.Now(), 4020ms);
  pace.steps_left = 0;
  EXPECT_FALSE(pacer.WaitFor(pace, 4, 2s).due);
  pace.paused = false;
  EXPECT_TRUE(pacer.WaitFor(pace, 4, 2s).due);
  EXPECT_TRUE(pacer.WaitFor(pace, 5, 2s).due);
  EXPECT_EQ(clock.Now(), 6030ms);
  EXPECT_EQ(pacer.reading().overruns, 0U);
  EXPECT_EQ(pacer.reading().shifts, 0U);
  EXPECT_EQ(pacer.reading().worst_lateness, 0);
}

TEST(PacerTest, FollowsANewSpeedFromTheStepThatIsNext) {
  test::ManualClock clock;
  Pacer pacer(&clock, kPeriod, 1);
  for (std::int64_t step = 0; step <= 10; ++step) pacer.WaitFor({.speed = 1}, step, 1s);
  EXPECT_EQ(clock.Now(), 100ms);
  EXPECT_TRUE(pacer.WaitFor({.speed = 0.1}, 11, 1s).due);
  EXPECT_EQ(clock.Now(), 100ms);
  EXPECT_TRUE(pacer.WaitFor({.speed = 0.1}, 12, 1s).due);
  EXPECT_EQ(clock.Now(), 200ms);
  EXPECT_TRUE(pacer.WaitFor({.speed = 0}, 13, 1s).due);
  EXPECT_TRUE(pacer.WaitFor({.speed = 0}, 14, 1s).due);
  EXPECT_EQ(clock.Now(), 200ms);
  EXPECT_EQ(pacer.reading().overruns, 0U);
}

}  // namespace
}  // namespace understudy::time
