#include "emulator/inbox.h"

#include <thread>
#include <utility>
#include <vector>

#include <sys/eventfd.h>

#include "gtest/gtest.h"
#include "tests/support/control.h"
#include "tests/support/requests.h"

namespace understudy::emulator {
namespace {

const Request kReset = test::RequestOf("reset"), kClamp = test::RequestOf("clamp", true);

Answer Fine(Request*, Reply*) { return {}; }

TEST(InboxTest, CarriesRequestsOutInOrderOfArrival) {
  Inbox inbox;
  for (const double by : {1.0, 2.0, 3.0})
    ASSERT_TRUE(inbox.Put(test::RequestOf("crane.lower", by)));
  std::vector<double> carried_out;
  inbox.Drain([&](Request* request, Reply*) {
    carried_out.push_back(request->number("by"));
    return Answer{};
  });
  EXPECT_EQ(carried_out, (std::vector<double>{1, 2, 3}));
}

TEST(InboxTest, ManyRequestsMakeNoLongTick) {
  Inbox inbox;
  std::size_t carried_out = 0;
  const auto drain = [&] {
    inbox.Drain([&](Request*, Reply*) {
      ++carried_out;
      return Answer{};
    });
    return std::exchange(carried_out, 0);
  };
  for (std::size_t i = 0; i < Inbox::kCapacity; ++i) inbox.Put(kClamp);
  EXPECT_EQ(drain(), Inbox::kMostAtOnce);
  std::size_t rest = 0;
  for (std::size_t some = drain(); some > 0; some = drain()) rest += some;
  EXPECT_EQ(rest, Inbox::kCapacity - Inbox::kMostAtOnce);
}

TEST(InboxTest, AResetIsTheLastOfItsTick) {
  Inbox inbox;
  for (const Request& request : {kClamp, kReset, kClamp}) inbox.Put(request);
  std::vector<std::string_view> kinds;
  const auto note = [&](Request* request, Reply*) {
    kinds.push_back(request->row->name);
    return Answer{};
  };
  inbox.Drain(note);
  ASSERT_EQ(kinds.size(), 2u);
  inbox.Drain(note);
  EXPECT_EQ(kinds.size(), 3u);
}

TEST(InboxTest, HandsBackTheAnswer) {
  Inbox inbox;
  auto asked = inbox.Put(test::RequestOf("crane.attach"));
  inbox.Drain([](Request*, Reply*) { return Answer{Error{"no crane here"}}; });
  EXPECT_EQ(asked->answer.get().why(), "no crane here");
}

TEST(InboxTest, AnAnswerMayBeGivenLater) {
  Inbox inbox;
  auto asked = inbox.Put(kReset);
  std::optional<Reply> kept;
  inbox.Drain([&](Request*, Reply* reply) -> std::optional<Answer> {
    kept = std::move(*reply);
    return std::nullopt;
  });
  EXPECT_EQ(asked->answer.wait_for(std::chrono::seconds{0}), std::future_status::timeout);
  kept->Give({});
  EXPECT_TRUE(asked->answer.get());
}

TEST(InboxTest, RingsWhenAnAnswerIsGivenAndNotBefore) {
  Inbox inbox;
  inbox.Put(kReset);
  std::uint64_t rings = 0;
  EXPECT_NE(::eventfd_read(inbox.bell(), &rings), 0);
  inbox.Drain(Fine);
  EXPECT_EQ(::eventfd_read(inbox.bell(), &rings), 0);
  EXPECT_EQ(rings, 1u);
}

TEST(InboxTest, TakesNoMoreThanItHolds) {
  Inbox inbox;
  for (std::size_t i = 0; i < Inbox::kCapacity; ++i) ASSERT_TRUE(inbox.Put(kReset));
  EXPECT_FALSE(inbox.Put(kReset));
  inbox.Drain(Fine);
  EXPECT_TRUE(inbox.Put(kReset));
}

TEST(InboxTest, DoesNotCarryOutWhatIsWithdrawn) {
  Inbox inbox;
  inbox.Put(kClamp);
  const auto asked = inbox.Put(kReset);
  inbox.Put(kClamp);
  EXPECT_TRUE(inbox.Withdraw(asked->number));
  EXPECT_FALSE(inbox.Withdraw(asked->number));
  std::vector<std::string_view> carried_out;
  inbox.Drain([&](Request* request, Reply*) {
    carried_out.push_back(request->row->name);
    return Answer{};
  });
  EXPECT_EQ(carried_out, (std::vector<std::string_view>{"clamp", "clamp"}));
}

TEST(InboxTest, WhatTheTickHasTakenIsNotWithdrawnAndNobodyWaitsForIt) {
  Inbox inbox;
  auto asked = inbox.Put(kReset);
  std::promise<void> inside;
  std::promise<void> leave;
  std::thread tick([&] {
    inbox.Drain([&](Request*, Reply*) {
      inside.set_value();
      leave.get_future().wait_for(test::kBound);
      return Answer{};
    });
  });
  inside.get_future().wait();
  EXPECT_FALSE(inbox.Withdraw(asked->number));
  EXPECT_TRUE(inbox.Put(kClamp));
  int carried_out = 0;
  inbox.Drain([&](Request*, Reply*) {  // would never return if it waited for the other
    ++carried_out;
    return Answer{};
  });
  EXPECT_EQ(carried_out, 1);
  leave.set_value();
  tick.join();
  EXPECT_TRUE(asked->answer.get());
}

TEST(InboxTest, EveryRequestOfManyThreadsIsAnsweredOnce) {
  constexpr int kThreads = 4;
  constexpr int kRequests = 200;
  Inbox inbox;
  std::atomic<int> carried_out = 0;
  std::atomic<int> answered = 0;
  {
    const test::Ticking ticking(&inbox, [&](const Request&) {
      ++carried_out;
      return Answer{};
    });
    std::vector<std::thread> threads;
    for (int i = 0; i < kThreads; ++i) {
      threads.emplace_back([&] {
        for (int k = 0; k < kRequests; ++k) {
          auto asked = inbox.Put(kClamp);
          if (asked && asked->answer.get().ok()) ++answered;
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  EXPECT_EQ(answered, kThreads * kRequests);
  EXPECT_EQ(carried_out, kThreads * kRequests);
}

}  // namespace
}  // namespace understudy::emulator
