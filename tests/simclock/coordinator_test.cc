#include "simclock/coordinator.h"

#include <csignal>
#include <functional>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "own_clock.h"

namespace understudy::simclock {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

test::ClockedRun Shell(const std::string& script, const test::ClockedOptions& options = {}) {
  return test::RunOnClock({"/bin/sh", "-c", script}, options);
}

TEST(CoordinatorTest, AMinuteOfSleepTakesAMomentOfWallTime) {
  const test::ClockedRun run = Shell("sleep 60");
  EXPECT_EQ(run.code, 0);
  EXPECT_GE(run.simulated, 60);
  EXPECT_LT(run.wall, 20);
}

TEST(CoordinatorTest, TimeStandsStillFromTheEndOfTheProgram) {
  const test::ClockedRun run = Shell("sleep 2");
  EXPECT_NEAR(run.simulated, 2, 0.002);
}

TEST(CoordinatorTest, AThreadThatIsSeenGoneAfterTheEndWasToldHoldsNoTime) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  const auto page = std::make_unique<Page>();
  page->program = child;
  page->used = 1;
  page->running = 1;
  page->slots[0].pid = child;
  page->slots[0].tid = child;
  page->slots[0].state = State::kRunning;
  Coordinator coordinator(page.get(), /*realtime=*/false);
  coordinator.ProgramEnded();
  using namespace std::chrono_literals;
  for (int i = 0; i < 3 && !coordinator.Reach(1ms, 1s); ++i) {
  }
  EXPECT_TRUE(coordinator.Reach(2ms, 1s));
}

TEST(CoordinatorTest, AThreadThatEndedWhileItWaitedWasNotRunning) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  const auto page = std::make_unique<Page>();
  page->used = 1;
  page->slots[0].pid = child;
  page->slots[0].tid = child;
  page->slots[0].state = State::kBlocked;
  page->slots[0].kind = Kind::kEvent;
  page->slots[0].deadline = kNever;
  Coordinator coordinator(page.get(), /*realtime=*/false);
  using namespace std::chrono_literals;
  EXPECT_TRUE(coordinator.Reach(1ms, 1s));
  EXPECT_EQ(page->running, 0);
}

// Else the loop would look without end, and keep the core from all that have no priority.
TEST(CoordinatorTest, AThreadForWhichTimeStandsDoesNotCountAsOneBesideWhichItGoesOn) {
  const pid_t child = ::fork();
  if (child == 0) {
    while (true) ::pause();
  }
  const auto page = std::make_unique<Page>();
  page->used = 1;
  page->running = 1;
  page->loose = 1;  // it was, before it began to ask
  page->slots[0].pid = child;
  page->slots[0].tid = child;
  page->slots[0].state = State::kRunning;
  page->slots[0].kind = Kind::kStands;
  Coordinator coordinator(page.get(), /*realtime=*/false);
  using namespace std::chrono_literals;
  EXPECT_FALSE(coordinator.Reach(1ms, 100ms));
  EXPECT_EQ(page->loose, 0);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

TEST(CoordinatorTest, WhatMayEndAPauseIsNotHeldByIt) {
  const auto page = std::make_unique<Page>();
  page->used = 2;
  for (Slot& slot : {std::ref(page->slots[0]), std::ref(page->slots[1])}) {
    slot.state = State::kBlocked;
    slot.deadline = kFirstInstant + 1'000'000;
  }
  page->slots[0].kind = Kind::kSleep;
  page->slots[1].kind = Kind::kAsks;
  Coordinator coordinator(page.get(), /*realtime=*/false);
  coordinator.Stand();
  EXPECT_EQ(page->slots[0].state, State::kBlocked);
  EXPECT_EQ(page->slots[1].state, State::kFired);
}

TEST(CoordinatorTest, TheProgramsExitCodeIsKept) {
  EXPECT_EQ(Shell("sleep 1; exit 7").code, 7);
  EXPECT_EQ(Shell("kill -9 $$").code, 128 + 9);
}

TEST(CoordinatorTest, ChildrenAreOnTheClock) {
  const test::ClockedRun run = Shell("sleep 1 & sleep 2; wait; sleep 3");
  EXPECT_EQ(run.code, 0);
  EXPECT_NEAR(run.simulated, 5, 0.1);
  EXPECT_THAT(run.unrepeatable, IsEmpty());
}

TEST(CoordinatorTest, TheDateIsTheSameInEachRun) {
  EXPECT_EQ(Shell("date -u +%F-%T; sleep 90; date -u +%F-%T").printed,
            "2026-01-01-00:00:00\n2026-01-01-00:01:30\n");
}

TEST(CoordinatorTest, ComputingTakesNoTime) {
  const test::ClockedRun run =
      Shell("i=0; while [ $i -lt 20000 ]; do i=$((i+1)); done; date +%s.%N");
  EXPECT_THAT(run.printed, HasSubstr(".000000000"));
}

TEST(CoordinatorTest, AChildThatDidNotTakeTheClockIsTold) {
  EXPECT_THAT(Shell("LD_PRELOAD= sleep 3").unrepeatable,
              AllOf(HasSubstr("sleep ("), HasSubstr("did not take the clock")));
}

TEST(CoordinatorTest, AThreadThatSleepsPastLibcIsTold) {
  const test::ClockedRun run = test::RunOnClock({UNDERSTUDY_WAITS, "unseen"});
  EXPECT_THAT(run.unrepeatable, AllOf(HasSubstr(" of waits ("), HasSubstr("sleeps in real time")));
}

TEST(CoordinatorTest, WaitsEndInAnOrderThatRepeats) {
  const std::string script =
      "for i in 11 13 17 19 23 29; do (for k in 1 2 3 4 5; do sleep 0.0${i}; echo $i$k; done) & "
      "done; "
      "wait";
  const std::string first = Shell(script).printed;
  EXPECT_EQ(first.size(), 6U * 5 * 4);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Shell(script).printed, first);
}

TEST(CoordinatorTest, TimeGoesOnBesideABusyLoopAndThatIsSaid) {
  const test::ClockedRun run =
      Shell("(while :; do :; done) & busy=$!; sleep 0.01; kill $busy; exit 0",
            {.most_computing = std::chrono::milliseconds(200)});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.unrepeatable, HasSubstr("computes and does not wait"));
}

TEST(CoordinatorTest, ABusyLoopWithPriorityDoesNotKeepTimeForEver) {
  const test::ClockedRun run =
      Shell("(while :; do :; done) & busy=$!; sleep 0.01; kill $busy; exit 0",
            {.realtime = true, .most_computing = std::chrono::milliseconds(200)});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.unrepeatable, HasSubstr("computes and does not wait"));
}

TEST(CoordinatorTest, AThreadThatComputesWhileItSaysThatItWaitsIsTold) {
  const test::ClockedRun run =
      test::RunOnClock({UNDERSTUDY_ODD_WAITS, "computes"},
                       {.realtime = true, .most_computing = std::chrono::milliseconds(200)});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.unrepeatable, HasSubstr("computes and does not wait"));
}

TEST(CoordinatorTest, TimeStandsWhileAThreadWaitsInRealTime) {
  for (const bool realtime : {false, true}) {
    const test::ClockedRun run =
        test::RunOnClock({UNDERSTUDY_ODD_WAITS, "stands"}, {.realtime = realtime});
    EXPECT_EQ(run.code, 0);
    EXPECT_THAT(run.unrepeatable, IsEmpty());
  }
}

// With it Linux may spin for ever in removing the child from /proc.
TEST(CoordinatorTest, AChildIsReapedWithoutPriority) {
  const test::ClockedRun run = Shell("export LD_PRELOAD=$LD_PRELOAD:" UNDERSTUDY_REAP_SPY
                                     "; exec " UNDERSTUDY_ODD_WAITS " reaps",
                                     {.realtime = true});
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.printed, "reaped\nreaped\nreaped\n");
}

}  // namespace
}  // namespace understudy::simclock
