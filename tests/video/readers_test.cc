#include "video/readers.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace understudy::video {
namespace {

// As a kernel prints it on a machine with the byte order of x86 and ARM.
const std::string kIgmp =
    "Idx\tDevice    : Count Querier\tGroup    Users Timer\tReporter\n"
    "1\tlo        :     2      V3\n"
    "\t\t\t\t010101E6     1 0:00000000\t\t0\n"
    "\t\t\t\t010000E0     1 0:00000000\t\t0\n"
    "4\teth0      :     1      V3\n"
    "\t\t\t\t010000E0     1 0:00000000\t\t0\n"
    "5\tenx001122334455:     1      V3\n"
    "\t\t\t\t010102E6     1 0:00000000\t\t0\n";
const std::string kUdp =
    "   sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid\n"
    "13931: 010101E6:06B8 00000000:0000 07 00000000:00000000 00:00000000 00000000     0\n"
    "  512: 00000000:1CE8 0100007F:06B9 07 00000000:00000000 00:00000000 00000000     0\n";

TEST(ReadersTest, FindAMemberOfTheGroupOnTheInterfaceThatHasIt) {
  EXPECT_TRUE(HasJoined(kIgmp, "lo", "230.1.1.1"));
  EXPECT_FALSE(HasJoined(kIgmp, "eth0", "230.1.1.1"));
  EXPECT_FALSE(HasJoined(kIgmp, "lo", "230.1.1.2"));
  EXPECT_FALSE(HasJoined(kIgmp, "lo", "230.1.2.1"));
  EXPECT_TRUE(HasJoined(kIgmp, "enx001122334455", "230.2.1.1"));
}

TEST(ReadersTest, FindASocketByItsLocalPort) {
  EXPECT_TRUE(IsOpen(kUdp, 1720));
  EXPECT_TRUE(IsOpen(kUdp, 7400));
  EXPECT_FALSE(IsOpen(kUdp, 1721));  // the other end's
  EXPECT_FALSE(IsOpen(kUdp, 0x6B));
}

TEST(ReadersTest, FindNothingInTextsOfAnotherForm) {
  for (const std::string text : {"", "\n", "\t", "lo", "1\n\t010101E6\n", "1 lo\n010101E6\n"}) {
    EXPECT_FALSE(HasJoined(text, "lo", "230.1.1.1")) << text;
    EXPECT_FALSE(IsOpen(text, 1720)) << text;
  }
  EXPECT_FALSE(HasJoined(kIgmp, "lo", "230.1.1"));
  EXPECT_FALSE(HasJoined(kIgmp, "", "230.1.1.1"));
}

TEST(ReadersTest, NeedBothAMemberAndASocket) {
  const test::TemporaryFolder net;
  EXPECT_FALSE(IsRead("lo", 1720, net.path()));
  std::ofstream(net.path() / "igmp") << kIgmp;
  EXPECT_FALSE(IsRead("lo", 1720, net.path()));
  std::ofstream(net.path() / "udp") << kUdp;
  EXPECT_TRUE(IsRead("lo", 1720, net.path()));
  EXPECT_FALSE(IsRead("lo", 1721, net.path()));
  EXPECT_FALSE(IsRead("eth0", 1720, net.path()));
}

}  // namespace
}  // namespace understudy::video
