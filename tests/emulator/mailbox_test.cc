#include "emulator/mailbox.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "emulator/snapshot_mailbox.h"
#include "emulator/status.h"
#include "tests/support/control.h"

namespace understudy::emulator {
namespace {

using Numbers = std::array<std::int64_t, 64>;

TEST(MailboxTest, GivesThePrototypeBeforeTheFirstPost) {
  const Mailbox<int> dut(7);
  EXPECT_EQ(*dut.Newest(), 7);
}

TEST(MailboxTest, GivesTheNewestAndLeavesWhatIsReadAsItIs) {
  Mailbox<int> dut;
  *dut.Claim() = 1;
  EXPECT_EQ(*dut.Newest(), 0);
  dut.Post();
  const auto first = dut.Newest();
  for (int i = 2; i < 100; ++i) {
    *dut.Claim() = i;
    dut.Post();
    EXPECT_EQ(*dut.Newest(), i);
  }
  EXPECT_EQ(*first, 1);
}

TEST(MailboxTest, HasNothingToWriteOnlyWhereAllIsRead) {
  Mailbox<int> dut;
  std::vector<Mailbox<int>::Reading> held;
  for (std::size_t i = 0; i + 1 < Mailbox<int>::kSlots; ++i) {
    ASSERT_NE(dut.Claim(), nullptr);
    dut.Post();
    held.push_back(dut.Newest());
  }
  ASSERT_NE(dut.Claim(), nullptr);
  dut.Post();
  EXPECT_EQ(dut.Claim(), nullptr);
  held.clear();
  EXPECT_NE(dut.Claim(), nullptr);
}

TEST(MailboxTest, GivesManySlowReadersWholeValuesAndNeverAnOlderOne) {
  Mailbox<Numbers> dut(Numbers{});
  std::atomic<bool> over = false;
  std::atomic<int> torn = 0, older = 0;
  std::atomic<int> unfinished = 5;
  std::vector<std::thread> readers;
  for (int i = 0; i < 5; ++i) {
    readers.emplace_back([&] {
      std::int64_t last = 0;
      for (int readings = 0; !over || readings == 0; ++readings) {
        const auto reading = dut.Newest();
        const std::int64_t first = reading->front();
        std::this_thread::yield();
        for (const std::int64_t number : *reading) torn += number != first ? 1 : 0;
        older += first < last ? 1 : 0;
        last = first;
        if (readings == 200) --unfinished;
      }
    });
  }
  std::int64_t posted = 0;
  int refused = 0;
  while (unfinished > 0) {
    Numbers* numbers = dut.Claim();
    if (numbers == nullptr) {
      ++refused;
      continue;
    }
    numbers->fill(++posted);
    dut.Post();
  }
  over = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(older, 0);
  EXPECT_EQ(refused, 0);
  EXPECT_EQ(dut.Newest()->front(), posted);
}

TEST(StatusBoardTest, KeepsTheLastPostHoweverOftenItIsRead) {
  StatusBoard dut;
  std::atomic<bool> over = false;
  std::thread reader([&] {
    while (!over) dut.Read();
  });
  for (std::int64_t steps = 1; steps <= 2000; ++steps) {
    Status status;
    status.steps = steps;
    dut.Post(status);
    ASSERT_EQ(dut.Read().steps, steps);
  }
  over = true;
  reader.join();
}

TEST(SnapshotMailboxTest, NothingIsWantedUntilSomebodyAsks) {
  SnapshotMailbox dut{Snapshot{}};
  const SnapshotMailbox::Observer* observer = dut.Join();
  EXPECT_EQ(dut.Wanted(), nullptr);
  EXPECT_FALSE(observer->bell().Answer());
}

TEST(SnapshotMailboxTest, OneSnapshotServesAllThatHaveAskedAndWakesThem) {
  SnapshotMailbox dut{Snapshot{}};
  SnapshotMailbox::Observer* one = dut.Join();
  SnapshotMailbox::Observer* other = dut.Join();
  const SnapshotMailbox::Observer* idle = dut.Join();
  one->Ask(kPartCom);
  other->Ask(kPartFeet);
  Snapshot* snapshot = dut.Wanted();
  ASSERT_NE(snapshot, nullptr);
  EXPECT_EQ(snapshot->parts, kPartCom | kPartFeet);
  EXPECT_FALSE(one->bell().Answer());
  snapshot->step = 3;
  dut.Post();
  EXPECT_TRUE(one->bell().Answer());
  EXPECT_TRUE(other->bell().Answer());
  EXPECT_FALSE(idle->bell().Answer());
  EXPECT_EQ(dut.Newest()->step, 3);
  EXPECT_EQ(dut.Wanted(), nullptr);
}

TEST(SnapshotMailboxTest, AskingForNoPartAsksForStepAndTime) {
  SnapshotMailbox dut{Snapshot{}};
  dut.Join()->Ask(0);
  const Snapshot* snapshot = dut.Wanted();
  ASSERT_NE(snapshot, nullptr);
  EXPECT_EQ(snapshot->parts, 0U);
}

TEST(SnapshotMailboxTest, HasRoomForSoManyObserversOnly) {
  SnapshotMailbox dut{Snapshot{}};
  for (std::size_t i = 0; i < SnapshotMailbox::kMostObservers; ++i) dut.Join();
  EXPECT_THROW(dut.Join(), std::length_error);
}

TEST(SnapshotMailboxTest, IsSafeBetweenTheTickAndTwoObservers) {
  SnapshotMailbox dut{Snapshot{}};
  const test::Showing tick(&dut);
  const auto observe = [&] {
    SnapshotMailbox::Observer* observer = dut.Join();
    std::int64_t last = 0;
    for (int i = 0; i < 50; ++i) {
      observer->Ask(kAllSnapshotParts);
      EXPECT_TRUE(test::Eventually([&] { return observer->bell().Answer(); }));
      EXPECT_GT(dut.Newest()->step, last);
      last = dut.Newest()->step;
    }
  };
  std::thread other(observe);
  observe();
  other.join();
}

}  // namespace
}  // namespace understudy::emulator
