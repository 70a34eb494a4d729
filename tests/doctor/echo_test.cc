#include "doctor/echo.h"

#include <gtest/gtest.h>

#include "doctor/echo_topics.h"

namespace understudy::doctor {
namespace {

using std::chrono::milliseconds;

constexpr Mark kMark{.session = 0xFFFFFFFF, .target = 2, .number = 3};

template <class Message>
class MarkTest : public ::testing::Test {};
using Messages = ::testing::Types<GoEcho::Ping, GoEcho::Pong, HgEcho::Ping, HgEcho::Pong>;
TYPED_TEST_SUITE(MarkTest, Messages);

TYPED_TEST(MarkTest, IsReadAsItWasPut) {
  TypeParam message{};
  Put(kMark, &message);
  EXPECT_EQ(MarkOf(message), kMark);
}

TEST(EchoNameTest, IsThatOfTheAnnouncement) {
  EXPECT_EQ(EchoName(AnnounceEcho("far")), "far");
  EXPECT_EQ(EchoName("understudy robot since 5"), std::nullopt);
  EXPECT_EQ(EchoName(AnnounceEcho(std::string(1000, 'x')))->size(), 64u);
}

TEST(AnnouncedAddressesTest, AreThoseOfOneMachineWhateverElseIsThere) {
  constexpr std::uint32_t kFar = 0xC0A87BDE;
  EXPECT_EQ(AnnouncedAddresses("udp/239.255.0.1:7400@2,udp/192.168.123.222:33485@2"),
            std::vector{kFar});
  EXPECT_EQ(AnnouncedAddresses("192.168.123.222"), std::vector{kFar});
  for (const char* const none :
       {"", ",", "udp/", "udp/192.168.123.2222:1", "tcp/[fe80::1]:1", "/:"}) {
    EXPECT_TRUE(AnnouncedAddresses(none).empty()) << none;
  }
}

// Without the bus: what a client makes of the numbers that come back.
class Counting : public EchoClient {
 public:
  void Try(std::uint32_t) override {}
  void Send(std::uint32_t, Time now) override { sent_at_.emplace_back(now); }
  void Receive(Time) override {}
  using EchoClient::Note;
};

constexpr std::chrono::nanoseconds kArrived = std::chrono::hours(500000);

TEST(EchoClientTest, CountsEachAnswerOnceAndNoneToWhatItDidNotSend) {
  Counting client;
  client.Send(1, milliseconds(0));
  client.Send(1, milliseconds(2));
  client.Note(2, milliseconds(5), kArrived, kArrived);
  client.Note(2, milliseconds(6), kArrived, kArrived);
  client.Note(3, milliseconds(6), kArrived, kArrived);
  client.Note(0xFFFFFFFF, milliseconds(6), kArrived, kArrived);
  EXPECT_EQ(client.sent(), 2);
  ASSERT_EQ(client.durations().size(), 1u);
  EXPECT_DOUBLE_EQ(client.durations().front(), 3e-3);
}

TEST(EchoClientTest, HearsAnAnswerToATryAndCountsNone) {
  Counting client;
  EXPECT_FALSE(client.answered());
  client.Note(0, milliseconds(1), kArrived, kArrived);
  EXPECT_TRUE(client.answered());
  EXPECT_TRUE(client.durations().empty());
}

TEST(EchoClientTest, TellsThePeersClockByTheQuickestAnswer) {
  Counting client;
  for (int i = 0; i < 3; ++i) client.Send(1, milliseconds(0));
  EXPECT_FALSE(client.offset());
  // The peer's clock is 5 s ahead; the second answer was quickest, the others lay about somewhere.
  const auto ahead = kArrived + std::chrono::seconds(5);
  client.Note(1, milliseconds(8), kArrived, ahead - milliseconds(1));
  client.Note(2, milliseconds(2), kArrived, ahead - milliseconds(1));
  client.Note(3, milliseconds(9), kArrived, ahead - milliseconds(8));
  ASSERT_TRUE(client.offset());
  EXPECT_NEAR(client.offset()->ahead, 5, 1e-9);
  EXPECT_NEAR(client.offset()->error, 1e-3, 1e-12);
}

TEST(EchoClientTest, BearsATimeThatIsNonsense) {
  Counting client;
  client.Send(1, milliseconds(0));
  client.Note(1, milliseconds(2), kArrived, std::chrono::nanoseconds::min());
  EXPECT_TRUE(client.offset());
}

template <class Message>
class TimeTest : public ::testing::Test {};
using Pongs = ::testing::Types<GoEcho::Pong, HgEcho::Pong>;
TYPED_TEST_SUITE(TimeTest, Pongs);

TYPED_TEST(TimeTest, IsReadAsItWasPutBesideTheMark) {
  for (const std::int64_t time : {std::int64_t{1800000000123456789}, std::int64_t{-1}}) {
    TypeParam message{};
    PutTime(time, &message);
    Put(kMark, &message);
    EXPECT_EQ(TimeOf(message), time);
    EXPECT_EQ(MarkOf(message), kMark);
  }
}

}  // namespace
}  // namespace understudy::doctor
