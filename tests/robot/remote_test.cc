#include "robot/remote.h"

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

constexpr std::uint16_t kL2 = 0x20, kB = 0x200;

TEST(RemoteTest, IsNotThereUntilItIsUsed) {
  Remote remote;
  EXPECT_FALSE(remote.Read(0).there);
  remote.Press(kB, 0.1);
  EXPECT_TRUE(remote.Read(0).there);
}

TEST(RemoteTest, LetsPressedKeysGo) {
  Remote remote;
  remote.Press(kL2 | kB, 1 + 0.1);
  EXPECT_EQ(remote.Read(1).keys, kL2 | kB);
  EXPECT_EQ(remote.Read(1.09).keys, kL2 | kB);
  EXPECT_EQ(remote.Read(1.11).keys, 0);
  EXPECT_TRUE(remote.Read(2).there);
}

TEST(RemoteTest, HoldsKeysUntilTheyAreReleased) {
  Remote remote;
  remote.Hold(kL2);
  remote.Press(kB, 0.1);
  EXPECT_EQ(remote.Read(0).keys, kL2 | kB);
  EXPECT_EQ(remote.Read(1000).keys, kL2);
  remote.Release(kL2);
  EXPECT_EQ(remote.Read(1000).keys, 0);
}

TEST(RemoteTest, MovesTheSticksThatAreNamed) {
  Remote remote;
  remote.Move(0, 0.5, kForever);
  remote.Move(1, -2, kForever);
  remote.Move(3, 0.25, 1);
  EXPECT_EQ(remote.Read(0.5).lx, 0.5);
  EXPECT_EQ(remote.Read(0.5).ly, -1);
  EXPECT_EQ(remote.Read(0.5).rx, 0);
  EXPECT_EQ(remote.Read(0.5).ry, 0.25);
  EXPECT_EQ(remote.Read(1.5).ry, 0);
  EXPECT_EQ(remote.Read(1e6).lx, 0.5);
}

TEST(RemoteTest, TakesNoRenewalThatComesTooLateForASecondPress) {
  Remote remote;
  remote.Renew({.keys = kL2 | kB}, 7, 0, 0.5);
  EXPECT_EQ(remote.Read(0.4).keys, kL2 | kB);
  remote.Renew({.keys = kL2 | kB}, 7, 0.4, 0.9);
  EXPECT_EQ(remote.Read(0.8).keys, kL2 | kB);
  EXPECT_EQ(remote.Read(0.95).keys, 0);
  remote.Renew({.keys = kL2 | kB, .lx = 1}, 7, 1, 1.5);
  EXPECT_EQ(remote.Read(1.1).keys, 0);
  EXPECT_EQ(remote.Read(1.1).lx, 1);  // what is no press is renewed all the same
  remote.Renew({.keys = kL2 | kB}, 7, 1.2, 1.7);
  EXPECT_EQ(remote.Read(1.3).keys, 0);
  remote.Renew({.keys = kL2 | kB}, 8, 1.4, 1.9);
  EXPECT_EQ(remote.Read(1.5).keys, kL2 | kB);
}

TEST(RemoteTest, PressesAgainWhatWasReleasedUnderTheSameNumber) {
  Remote remote;
  remote.Renew({.keys = kB}, 7, 0, 0.5);
  remote.Renew({}, 7, 0.1, 0.6);
  remote.Renew({.keys = kB}, 7, 0.2, 0.7);
  EXPECT_EQ(remote.Read(0.3).keys, kB);
}

TEST(RemoteTest, IsAsItWasSetAndNothingElse) {
  Remote remote;
  remote.Hold(kL2);
  remote.Move(2, 1, kForever);
  remote.Set({.keys = kB, .lx = 2, .ly = -0.5}, 1.5);
  EXPECT_TRUE(remote.Read(1).there);
  EXPECT_EQ(remote.Read(1).keys, kB);
  EXPECT_EQ(remote.Read(1).lx, 1);
  EXPECT_EQ(remote.Read(1).ly, -0.5);
  EXPECT_EQ(remote.Read(1).rx, 0);
}

TEST(RemoteTest, IsLetGoByWhoeverDoesNotSayAgainThatItIsHeld) {
  Remote remote;
  const RemoteReading held{.keys = kL2, .ry = 1};
  remote.Set(held, 0.5);
  remote.Set(held, 0.9);
  EXPECT_EQ(remote.Read(0.8).keys, kL2);
  EXPECT_EQ(remote.Read(0.8).ry, 1);
  EXPECT_EQ(remote.Read(0.91).keys, 0);
  EXPECT_EQ(remote.Read(0.91).ry, 0);
  EXPECT_TRUE(remote.Read(0.91).there);
}

TEST(RemoteTest, ForgetsEverythingWhenItGoes) {
  Remote remote;
  remote.Hold(kL2);
  remote.Move(0, 1, kForever);
  remote.Switch(false);
  EXPECT_FALSE(remote.Read(0).there);
  remote.Switch(true);
  EXPECT_EQ(remote.Read(0).keys, 0);
  EXPECT_EQ(remote.Read(0).lx, 0);
}

}  // namespace
}  // namespace understudy::robot
