#include "emulator/inbox.h"

#include <thread>
#include <utility>
#include <vector>

#include "gtest/gtest.h"
#include "tests/support/control.h"

namespace understudy::emulator {
namespace {

using std::chrono::steady_clock;

const auto kNever = steady_clock::time_point::max();

Answer Fine(const Order&) { return {}; }

TEST(InboxTest, CarriesOrdersOutInOrderOfArrival) {
  Inbox inbox;
  for (const double by : {1.0, 2.0, 3.0}) ASSERT_TRUE(inbox.Put(LowerCrane{by}, kNever));
  std::vector<double> carried_out;
  inbox.Drain([&](const Order& order) {
    carried_out.push_back(std::get<LowerCrane>(order).by);
    return Answer{};
  });
  EXPECT_EQ(carried_out, (std::vector<double>{1, 2, 3}));
}

TEST(InboxTest, ManyOrdersMakeNoLongTick) {
  Inbox inbox;
  std::size_t carried_out = 0;
  const auto drain = [&] {
    inbox.Drain([&](const Order&) {
      ++carried_out;
      return Answer{};
    });
    return std::exchange(carried_out, 0);
  };
  for (std::size_t i = 0; i < Inbox::kCapacity; ++i) inbox.Put(ClampBase{true}, kNever);
  EXPECT_EQ(drain(), Inbox::kMostAtOnce);
  std::size_t rest = 0;
  for (std::size_t some = drain(); some > 0; some = drain()) rest += some;
  EXPECT_EQ(rest, Inbox::kCapacity - Inbox::kMostAtOnce);
}

TEST(InboxTest, AResetIsTheLastOfItsTick) {
  Inbox inbox;
  for (const Order& order :
       {Order{ClampBase{true}}, Order{ResetRobot{}}, Order{ClampBase{false}}}) {
    inbox.Put(order, kNever);
  }
  std::vector<std::size_t> kinds;
  const auto note = [&](const Order& order) {
    kinds.push_back(order.index());
    return Answer{};
  };
  inbox.Drain(note);
  ASSERT_EQ(kinds.size(), 2u);
  inbox.Drain(note);
  EXPECT_EQ(kinds.size(), 3u);
}

TEST(InboxTest, HandsBackTheAnswer) {
  Inbox inbox;
  auto answer = inbox.Put(AttachCrane{}, kNever);
  inbox.Drain([](const Order&) { return Answer{"no crane here"}; });
  EXPECT_EQ(answer->get(), "no crane here");
}

TEST(InboxTest, TakesNoMoreThanItHolds) {
  Inbox inbox;
  for (std::size_t i = 0; i < Inbox::kCapacity; ++i) ASSERT_TRUE(inbox.Put(ResetRobot{}, kNever));
  EXPECT_FALSE(inbox.Put(ResetRobot{}, kNever));
  inbox.Drain(Fine);
  EXPECT_TRUE(inbox.Put(ResetRobot{}, kNever));
}

TEST(InboxTest, DoesNotCarryOutWhatNobodyWaitsForAnyMore) {
  Inbox inbox;
  auto answer = inbox.Put(ResetRobot{}, steady_clock::now() - std::chrono::seconds{1});
  int carried_out = 0;
  inbox.Drain([&](const Order&) {
    ++carried_out;
    return Answer{};
  });
  EXPECT_EQ(carried_out, 0);
  EXPECT_NE(answer->get(), "");
}

TEST(InboxTest, DrainReturnsAtOnceWhileAnotherThreadIsAtTheInbox) {
  Inbox inbox;
  ASSERT_TRUE(inbox.Put(ResetRobot{}, kNever));
  std::promise<void> inside;
  std::promise<void> leave;
  std::thread other([&] {
    inbox.Drain([&](const Order&) {
      inside.set_value();
      leave.get_future().wait_for(test::kBound);
      return Answer{};
    });
  });
  inside.get_future().wait();
  int carried_out = 0;
  inbox.Drain([&](const Order&) {  // would never return if it waited for the other
    ++carried_out;
    return Answer{};
  });
  EXPECT_EQ(carried_out, 0);
  leave.set_value();
  other.join();
}

TEST(InboxTest, EveryOrderOfManyThreadsIsAnsweredOnce) {
  constexpr int kThreads = 4;
  constexpr int kOrders = 200;
  Inbox inbox;
  std::atomic<int> carried_out = 0;
  std::atomic<int> answered = 0;
  {
    const test::Ticking ticking(&inbox, [&](const Order&) {
      ++carried_out;
      return Answer{};
    });
    std::vector<std::thread> threads;
    for (int i = 0; i < kThreads; ++i) {
      threads.emplace_back([&] {
        for (int k = 0; k < kOrders; ++k) {
          auto answer = inbox.Put(ClampBase{true}, kNever);
          if (answer && answer->get().empty()) ++answered;
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  EXPECT_EQ(answered, kThreads * kOrders);
  EXPECT_EQ(carried_out, kThreads * kOrders);
}

}  // namespace
}  // namespace understudy::emulator
