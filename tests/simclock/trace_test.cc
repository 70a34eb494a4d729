#include "simclock/trace.h"

#include <atomic>
#include <cstring>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <unistd.h>

#include "own_clock.h"
#include "tests/support/eventually.h"

namespace understudy::simclock {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// A page on which this thread is at 1.5 s.
class TraceTest : public testing::Test {
 protected:
  TraceTest() {
    page_->now = kFirstInstant + 1'500'000'000;
    page_->used = 1;
    slot_.pid = ::getpid();
    slot_.tid = ::gettid();
    slot_.state = State::kRunning;
    std::strcpy(slot_.what.data(), "condition");
  }
  std::string Text(bool stands = false) const {
    return WaitsText(*page_, Sleepers(page_.get()), stands);
  }

  std::unique_ptr<Page> page_ = std::make_unique<Page>();
  Slot& slot_ = page_->slots[0];
};

TEST_F(TraceTest, NamesWhoWaitsForWhatUntilWhen) {
  slot_.state = State::kBlocked;
  slot_.deadline = kFirstInstant + 2'250'000'000;
  EXPECT_EQ(Text(), "clock: 1.500000 s\n  thread " + std::to_string(::gettid()) +
                        " of simclock_test (" + std::to_string(::getpid()) +
                        "): waits in condition until 2.250000 s\n");
  slot_.deadline = kNever;
  EXPECT_THAT(Text(), HasSubstr("waits in condition for an event, without a time-out\n"));
  slot_.state = State::kFired;
  EXPECT_THAT(Text(), HasSubstr("wakes: its time has come\n"));
}

TEST_F(TraceTest, NamesAThreadThatComputes) {
  std::atomic<int> tid = 0;
  const std::jthread computes([&tid](const std::stop_token& stop) {
    for (tid = ::gettid(); !stop.stop_requested();) {
    }
  });
  ASSERT_TRUE(test::Eventually([&] { return tid != 0; }));
  slot_.tid = tid.load();
  EXPECT_THAT(Text(), AllOf(HasSubstr("computes, "), HasSubstr(" s of the processor so far\n")));
}

TEST_F(TraceTest, NamesTheCallInWhichAThreadSleepsUntold) {
  std::atomic<int> tid = 0;
  const std::jthread sleeps([&tid](const std::stop_token& stop) {
    tid = ::gettid();
    while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  });
  ASSERT_TRUE(test::Eventually([&] { return tid != 0; }));
  slot_.tid = tid.load();
  ASSERT_TRUE(test::Eventually([&] { return Text().find("nanosleep") != std::string::npos; }));
  EXPECT_THAT(Text(), Not(HasSubstr("waits in")));
}

TEST_F(TraceTest, LeavesOutSlotsOfNobody) {
  slot_.state = State::kFree;
  EXPECT_EQ(Text(true), "clock: 1.500000 s, where it has stood since it was last told\n");
}

TEST_F(TraceTest, TellsOnceWhereNothingChanges) {
  slot_.state = State::kBlocked;
  slot_.deadline = kNever;
  std::mutex mutex;
  std::string told;
  std::atomic<int> times = 0;
  const WaitTrace trace(
      page_.get(),
      [&](const std::string& lines) {
        const std::lock_guard lock(mutex);
        told = lines;
        ++times;
      },
      std::chrono::milliseconds(1));
  ASSERT_TRUE(test::Eventually([&] { return times == 2; }));
  {
    const std::lock_guard lock(mutex);
    EXPECT_THAT(told, HasSubstr("where it has stood"));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(times, 2);
  page_->now = kFirstInstant + 1'600'000'000;
  ASSERT_TRUE(test::Eventually([&] { return times >= 3; }));
}

}  // namespace
}  // namespace understudy::simclock
