#include "robot/remote_keys.h"

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

TEST(RemoteKeysTest, HaveTheVendorsBits) {
  EXPECT_EQ(RemoteKeys("R1"), 1);
  EXPECT_EQ(RemoteKeys("A"), 0x100);
  EXPECT_EQ(RemoteKeys("LEFT"), 0x8000);
  EXPECT_EQ(RemoteKeys("L2+B"), 0x220);
  EXPECT_EQ(RemoteKeys("b+l2"), 0x220);
}

TEST(RemoteKeysTest, AreNothingElse) {
  for (const char* bad : {"", "+", "L2+", "L3", "L2 B", "L2++B"}) {
    EXPECT_FALSE(RemoteKeys(bad).has_value()) << bad;
  }
}

TEST(RemoteKeysTest, AreNamedInTheOrderOfTheirBits) {
  EXPECT_EQ(RemoteKeyNames(0), "");
  EXPECT_EQ(RemoteKeyNames(0x220), "L2+B");
}

}  // namespace
}  // namespace understudy::robot
