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

using std::chrono::steady_clock;

constexpr auto kNever = steady_clock::time_point::max();
constexpr steady_clock::duration kNow = std::chrono::seconds{100};

const Request kReset = test::RequestOf("reset"), kClamp = test::RequestOf("clamp", true);

Answer Fine(Request*, Reply*) { return {}; }

TEST(InboxTest, CarriesRequestsOutInOrderOfArrival) {
  Inbox inbox;
  for (const double by : {1.0, 2.0, 3.0})
    ASSERT_TRUE(inbox.Put(test::RequestOf("crane.lower", by), kNever));
  std::vector<double> carried_out;
  inbox.Drain(kNow, [&](Request* request, Reply*) {
    carried_out.push_back(request->number("by"));
    return Answer{};
  });
  EXPECT_EQ(carried_out, (std::vector<double>{1, 2, 3}));
}

TEST(InboxTest, ManyRequestsMakeNoLongTick) {
  Inbox inbox;
  std::size_t carried_out = 0;
  const auto drain = [&] {
    inbox.Drain(kNow, [&](Request*, Reply*) {
      ++carried_out;
      return Answer{};
    });
    return std::exchange(carried_out, 0);
  };
  for (std::size_t i = 0; i < Inbox::kCapacity; ++i) inbox.Put(kClamp, kNever);
  EXPECT_EQ(drain(), Inbox::kMostAtOnce);
  std::size_t rest = 0;
  for (std::size_t some = drain(); some > 0; some = drain()) rest += some;
  EXPECT_EQ(rest, Inbox::kCapacity - Inbox::kMostAtOnce);
}

TEST(InboxTest, AResetIsTheLastOfItsTick) {
  Inbox inbox;
  for (const Request& request : {kClamp, kReset, kClamp}) inbox.Put(request, kNever);
  std::vector<std::string_view> kinds;
  const auto note = [&](Request* request, Reply*) {
    kinds.push_back(request->row->name);
    return Answer{};
  };
  inbox.Drain(kNow, note);
  ASSERT_EQ(kinds.size(), 2u);
  inbox.Drain(kNow, note);
  EXPECT_EQ(kinds.size(), 3u);
}

TEST(InboxTest, HandsBackTheAnswer) {
  Inbox inbox;
  auto answer = inbox.Put(test::RequestOf("crane.attach"), kNever);
  inbox.Drain(kNow, [](Request*, Reply*) { return Answer{Error{"no crane here"}}; });
  EXPECT_EQ(answer->get().why(), "no crane here");
}

TEST(InboxTest, AnAnswerMayBeGivenLater) {
  Inbox inbox;
  auto answer = inbox.Put(kReset, kNever);
  std::optional<Reply> kept;
  inbox.Drain(kNow, [&](Request*, Reply* reply) -> std::optional<Answer> {
    kept = std::move(*reply);
    return std::nullopt;
  });
  EXPECT_EQ(answer->wait_for(std::chrono::seconds{0}), std::future_status::timeout);
  kept->Give({});
  EXPECT_TRUE(answer->get());
}

TEST(InboxTest, RingsWhenAnAnswerIsGivenAndNotBefore) {
  Inbox inbox;
  inbox.Put(kReset, kNever);
  std::uint64_t rings = 0;
  EXPECT_NE(::eventfd_read(inbox.bell(), &rings), 0);
  inbox.Drain(kNow, Fine);
  EXPECT_EQ(::eventfd_read(inbox.bell(), &rings), 0);
  EXPECT_EQ(rings, 1u);
}

TEST(InboxTest, TakesNoMoreThanItHolds) {
  Inbox inbox;
  for (std::size_t i = 0; i < Inbox::kCapacity; ++i) ASSERT_TRUE(inbox.Put(kReset, kNever));
  EXPECT_FALSE(inbox.Put(kReset, kNever));
  inbox.Drain(kNow, Fine);
  EXPECT_TRUE(inbox.Put(kReset, kNever));
}

TEST(InboxTest, DoesNotCarryOutWhatNobodyWaitsForAnyMore) {
  Inbox inbox;
  auto answer = inbox.Put(kReset, steady_clock::time_point(kNow - std::chrono::nanoseconds{1}));
  int carried_out = 0;
  inbox.Drain(kNow, [&](Request*, Reply*) {
    ++carried_out;
    return Answer{};
  });
  EXPECT_EQ(carried_out, 0);
  EXPECT_FALSE(answer->get());
}

TEST(InboxTest, DrainReturnsAtOnceWhileAnotherThreadIsAtTheInbox) {
  Inbox inbox;
  ASSERT_TRUE(inbox.Put(kReset, kNever));
  std::promise<void> inside;
  std::promise<void> leave;
  std::thread other([&] {
    inbox.Drain(kNow, [&](Request*, Reply*) {
      inside.set_value();
      leave.get_future().wait_for(test::kBound);
      return Answer{};
    });
  });
  inside.get_future().wait();
  int carried_out = 0;
  inbox.Drain(kNow, [&](Request*, Reply*) {  // would never return if it waited for the other
    ++carried_out;
    return Answer{};
  });
  EXPECT_EQ(carried_out, 0);
  leave.set_value();
  other.join();
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
          auto answer = inbox.Put(kClamp, kNever);
          if (answer && answer->get().ok()) ++answered;
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
