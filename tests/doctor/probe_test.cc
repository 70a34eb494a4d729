#include "doctor/probe.h"

#include <random>

#include <gtest/gtest.h>

#include "bus/participant.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"

namespace understudy::doctor {
namespace {

constexpr std::uint32_t kLoopback = 0x7F000001;

TEST(DatagramTest, IsReadAsItWasWritten) {
  const Datagram datagram{.kind = DatagramKind::kAnswerAll,
                          .session = 0xDEADBEEF,
                          .number = 12,
                          .name = "thirty-two-characters-are-the-most"};
  Datagram cut = datagram;
  cut.name.resize(32);
  EXPECT_EQ(Decode(Encode(datagram)), cut);
}

TEST(DatagramTest, RefusesAnotherLengthMagicOrKind) {
  const auto bytes = Encode({.kind = DatagramKind::kAskOne});
  ASSERT_TRUE(Decode(bytes));
  EXPECT_FALSE(Decode(std::span(bytes).first(kDatagramBytes - 1)));
  EXPECT_FALSE(Decode({}));
  for (const std::size_t at : {0U, 7U, 8U}) {
    auto other = bytes;
    other[at] ^= std::byte{0x40};
    EXPECT_FALSE(Decode(other)) << at;
  }
  auto kind = bytes;
  kind[8] = std::byte{0};
  EXPECT_FALSE(Decode(kind));
}

TEST(DatagramTest, GivesANameThatATerminalMayShowWhateverTheBytes) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    auto bytes = Encode({.kind = DatagramKind::kAnswerOne});
    for (std::size_t at = 20; at < bytes.size(); ++at) bytes[at] = static_cast<std::byte>(random());
    const auto datagram = Decode(bytes);
    ASSERT_TRUE(datagram);
    for (const char letter : datagram->name) EXPECT_FALSE(letter > 0 && letter < 32);
  }
}

TEST(ProbePortTest, FitsIntoSixteenBitsInEveryDomainAndIsItsOwn) {
  for (int domain = 0; domain <= bus::kLastDomain; ++domain) {
    EXPECT_EQ(ProbePort(domain), 7530 + 250 * domain);
  }
}

class ProbeTest : public ::testing::Test {
 protected:
  // Lets both work until the client has what it waits for.
  template <class Holds>
  bool Works(Holds&& holds) {
    return test::Eventually([&] {
      server_.Answer();
      client_.Receive();
      return holds();
    });
  }

  int domain_ = test::NewDomain();
  ProbeServer server_{"lo", kLoopback, domain_, "far"};
  ProbeClient client_{"lo", kLoopback, domain_, 7, "far"};
};

TEST_F(ProbeTest, CountsWhatComesBackEachWay) {
  client_.SetPeer(kLoopback);
  client_.Ask();
  client_.Ask();
  ASSERT_TRUE(Works([&] { return client_.from_peer().returned == 2; }));
  ASSERT_TRUE(Works([&] { return client_.multicast().returned == 2; }));
  EXPECT_EQ(client_.unicast().sent, 2);
  EXPECT_EQ(client_.unicast().returned, 2);
  EXPECT_EQ(client_.self_multicast().sent, 2);
  EXPECT_EQ(client_.self_multicast().returned, 2);
  EXPECT_EQ(client_.from_peer().sent, 2);
}

TEST_F(ProbeTest, LearnsTheAddressOfAPeerByItsName) {
  client_.Ask();
  ASSERT_TRUE(Works([&] { return client_.multicast().returned == 1; }));
  EXPECT_EQ(client_.peer(), kLoopback);
}

TEST_F(ProbeTest, CountsNoAnswersOfOthers) {
  ProbeClient other("lo", kLoopback, domain_, 8, "near");
  other.Ask();
  other.Ask();
  client_.Ask();
  ASSERT_TRUE(Works([&] { return client_.multicast().returned == 1; }));
  other.Receive();
  EXPECT_EQ(other.multicast().returned, 0);
  EXPECT_EQ(other.self_multicast().returned, 2);
  EXPECT_EQ(client_.self_multicast().returned, 1);
}

TEST_F(ProbeTest, CountsWhatTwoAnswerOnce) {
  ProbeServer twin("lo", kLoopback, domain_, "far");
  client_.Ask();
  client_.Ask();
  server_.Answer();
  twin.Answer();
  ASSERT_TRUE(Works([&] { return client_.multicast().returned == 2; }));
  client_.Ask();
  ASSERT_TRUE(Works([&] { return client_.multicast().returned == 3; }));
  EXPECT_EQ(client_.multicast().sent, 3);
}

TEST(ProbeClientTest, TellsThatNobodyListens) {
  ProbeClient client("lo", kLoopback, test::NewDomain(), 7, "");
  client.SetPeer(kLoopback);
  client.Ask();
  ASSERT_TRUE(test::Eventually([&] {
    client.Receive();
    return client.unicast().error != 0;
  }));
  EXPECT_EQ(client.unicast().error, ECONNREFUSED);
  EXPECT_EQ(client.unicast().returned, 0);
  EXPECT_EQ(client.multicast().error, 0);
}

}  // namespace
}  // namespace understudy::doctor
