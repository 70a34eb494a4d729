#include "remote/remote_sender.h"

#include <vector>

#include <gtest/gtest.h>

#include "emulator/request.h"

namespace understudy::remote {
namespace {

class RemoteSenderTest : public ::testing::Test {
 protected:
  // Every 5 ms from `from` to `to`.
  void HoldFor(const robot::RemoteReading& reading, double from, double to) {
    for (double t = from; t < to; t += 0.005) sender_.Hold(reading, t);
  }

  std::vector<emulator::Request> sent_;
  RemoteSender sender_{[this](const nlohmann::json& values) {
    const auto request = emulator::ReadRequest("remote.set", values);
    ASSERT_TRUE(request) << request.why();
    sent_.push_back(*request);
  }};
};

constexpr robot::RemoteReading kB{.keys = 0x200};

TEST_F(RemoteSenderTest, SwitchesTheRemoteOnAndIsThenSilentWhileNothingIsHeld) {
  HoldFor({}, 0, 60);
  ASSERT_EQ(sent_.size(), 1u);
  EXPECT_EQ(sent_[0].number("keys"), 0);
}

TEST_F(RemoteSenderTest, TellsAChangeAtOnce) {
  HoldFor({}, 0, 1);
  sender_.Hold(kB, 1);
  ASSERT_EQ(sent_.size(), 2u);
  EXPECT_EQ(sent_[1].number("keys"), 0x200);
  sender_.Hold({}, 1.02);
  ASSERT_EQ(sent_.size(), 3u);
  EXPECT_EQ(sent_[2].number("keys"), 0);
}

TEST_F(RemoteSenderTest, SaysAgainWhatIsHeldLongBeforeItWouldBeLetGo) {
  HoldFor(kB, 0, 1);
  EXPECT_GE(sent_.size(), 9u);
  EXPECT_LE(sent_.size(), 12u);
  EXPECT_EQ(sent_[0].number("for"), kLetGoAfter);
  EXPECT_LT(4 * kRenewEvery, kLetGoAfter);
}

TEST_F(RemoteSenderTest, TellsNoMoreThanAHundredChangesASecond) {
  for (int i = 0; i < 1000; ++i) sender_.Hold({.lx = i / 1000.0}, i / 1000.0);
  EXPECT_LE(sent_.size(), 101u);
  EXPECT_GE(sent_.size(), 90u);
}

TEST_F(RemoteSenderTest, CountsInTheRobotsTime) {
  sender_.set_speed(20);
  sender_.Hold(kB, 0);
  EXPECT_EQ(sent_[0].number("for"), 20 * kLetGoAfter);
}

TEST_F(RemoteSenderTest, LetsGoOnce) {
  sender_.LetGo(0);
  EXPECT_TRUE(sent_.empty());
  sender_.Hold(kB, 0);
  sender_.LetGo(0.001);
  sender_.LetGo(0.002);
  ASSERT_EQ(sent_.size(), 2u);
  EXPECT_EQ(sent_[1].number("keys"), 0);
}

TEST_F(RemoteSenderTest, TellsTheValuesOfTheRequest) {
  sender_.Hold({.there = true, .keys = 0x220, .lx = 0.5, .ry = -1}, 0);
  ASSERT_EQ(sent_.size(), 1u);
  EXPECT_EQ(sent_[0].number("keys"), 0x220);
  EXPECT_EQ(sent_[0].number("lx"), 0.5);
  EXPECT_EQ(sent_[0].number("ry"), -1);
}

TEST_F(RemoteSenderTest, NumbersPressesAndNoRenewals) {
  HoldFor(kB, 0, 1);
  for (const emulator::Request& renewal : sent_) {
    EXPECT_EQ(renewal.number("press"), sent_[0].number("press"));
  }
  sender_.Hold({.keys = 0x220}, 1);
  EXPECT_EQ(sent_.back().number("press"), sent_[0].number("press") + 1);
  sender_.Hold(kB, 1.1);
  EXPECT_EQ(sent_.back().number("press"), sent_[0].number("press") + 1);
  sender_.Hold({}, 1.2);
  sender_.Hold(kB, 1.3);
  EXPECT_EQ(sent_.back().number("press"), sent_[0].number("press") + 2);
}

}  // namespace
}  // namespace understudy::remote
