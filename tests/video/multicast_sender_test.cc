// Over the loopback of this machine.
#include "video/multicast_sender.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/video/joined.h"
#include "video/readers.h"

namespace understudy::video {
namespace {

TEST(MulticastSenderTest, ReachesAProgramThatHasJoined) {
  const test::Joined reader;
  EXPECT_TRUE(IsRead("lo", reader.port()));
  const std::vector<std::uint8_t> packet{1, 2, 3};
  ASSERT_TRUE(MulticastSender("lo", reader.port()).Send(packet));
  EXPECT_EQ(reader.Receive(), packet);
}

TEST(MulticastSenderTest, SaysWhatDoesNotLeave) {
  const std::vector<std::uint8_t> longer_than_udp_has(70'000);
  EXPECT_FALSE(MulticastSender("lo", 1).Send(longer_than_udp_has));
}

TEST(MulticastSenderTest, NamesAnInterfaceThatIsNotThere) {
  try {
    const MulticastSender sender("nowhere9", 1720);
    FAIL();
  } catch (const SetupError& error) {
    EXPECT_STREQ(error.what(), "no video stream to 230.1.1.1 on nowhere9: No such device");
  }
}

}  // namespace
}  // namespace understudy::video
