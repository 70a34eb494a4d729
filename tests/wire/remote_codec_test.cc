#include "wire/remote_codec.h"

#include <cstring>

#include <gmock/gmock.h>

namespace understudy::wire {
namespace {

using ::testing::Each;

float FloatAt(const std::array<std::uint8_t, 40>& bytes, std::size_t at) {
  float value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

TEST(RemoteCodecTest, IsAllZeroWhileNoRemoteIsThere) {
  EXPECT_THAT(EncodeRemote(robot::RemoteReading{}), Each(0));
}

TEST(RemoteCodecTest, PutsKeysAndSticksWhereTheVendorReadsThem) {
  const auto bytes =
      EncodeRemote({.there = true, .keys = 0x0220, .lx = 0.25, .ly = -1, .rx = 0.5, .ry = 0.75});
  EXPECT_EQ(bytes[0], 0x55);
  EXPECT_EQ(bytes[1], 0x51);
  EXPECT_EQ(bytes[2], 0x20);  // L2
  EXPECT_EQ(bytes[3], 0x02);  // B
  EXPECT_EQ(FloatAt(bytes, 4), 0.25F);
  EXPECT_EQ(FloatAt(bytes, 8), 0.5F);
  EXPECT_EQ(FloatAt(bytes, 12), 0.75F);
  EXPECT_EQ(FloatAt(bytes, 16), 1);  // L2
  EXPECT_EQ(FloatAt(bytes, 20), -1);
  for (std::size_t i = 24; i < bytes.size(); ++i) EXPECT_EQ(bytes[i], 0) << i;
}

TEST(RemoteCodecTest, TellsTheSameOnItsOwnTopic) {
  unitree_go_msg_dds__WirelessController_ message{};
  EncodeRemote({.there = true, .keys = 4, .lx = 0.25, .ly = -1, .rx = 0.5, .ry = 0.75}, &message);
  EXPECT_EQ(message.keys, 4);
  EXPECT_EQ(message.lx, 0.25F);
  EXPECT_EQ(message.ly, -1);
  EXPECT_EQ(message.rx, 0.5F);
  EXPECT_EQ(message.ry, 0.75F);
}

}  // namespace
}  // namespace understudy::wire
