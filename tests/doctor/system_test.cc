#include "doctor/system.h"

#include <gtest/gtest.h>

#include "doctor/measurements.h"
#include "doctor/states_watch.h"

namespace understudy::doctor {
namespace {

using std::chrono::milliseconds;

TEST(SystemTest, KnowsLoopback) {
  const auto link = ReadLink("lo");
  ASSERT_TRUE(link);
  EXPECT_TRUE(link->loopback);
  EXPECT_TRUE(link->up);
  EXPECT_EQ(OwnAddress(ReadAddresses(), "lo"), 0x7F000001u);
  EXPECT_FALSE(ReadLink("none"));
  EXPECT_EQ(OwnAddress(ReadAddresses(), "none"), 0u);
}

TEST(SystemTest, GetsTheBufferThatItAsksForUpToTheKernelsLimit) {
  EXPECT_GE(GrantedBuffer(true, 8192).value_or(0), 8192);
  const int most = GrantedBuffer(true, 1 << 30).value_or(0);
  EXPECT_GE(most, GrantedBuffer(true, 8192).value_or(0));
  EXPECT_LT(most, 1 << 30);
}

TEST(SystemTest, ReadsTheCountersThatTheKernelKeeps) {
  EXPECT_TRUE(ReadDropCounts("lo"));
  EXPECT_FALSE(ReadDropCounts("none"));
  EXPECT_GE(ReadLoad().value_or(-1), 0);
}

constexpr char kColumns[] =
    "Iface Destination Gateway Flags RefCnt Use Metric Mask MTU Window IRTT\n";
constexpr char kDefault[] = "wlan0 00000000 0100A8C0 0003 0 0 600 00000000 0 0 0\n";
constexpr std::uint32_t kGroup = 0xEFFF0001;

std::string Route(const std::string& rows) { return RouteTo(kGroup, kColumns + rows); }

TEST(RouteTest, IsThatOfTheLongestMaskAndAmongEqualsTheLeastMetric) {
  EXPECT_EQ(Route(""), "");
  EXPECT_EQ(RouteTo(kGroup, ""), "");
  EXPECT_EQ(Route(kDefault), "wlan0");
  EXPECT_EQ(Route("eth0 007BA8C0 00000000 0001 0 0 0 00FFFFFF 0 0 0\n"), "");
  const std::string multicast = "eth0 000000E0 00000000 0001 0 0 0 000000F0 0 0 0\n";
  EXPECT_EQ(Route(multicast + kDefault), "eth0");
  EXPECT_EQ(Route(kDefault + multicast), "eth0");
  EXPECT_EQ(Route(std::string(kDefault) + "eth1 00000000 0 0003 0 0 100 00000000 0 0 0\n"), "eth1");
  EXPECT_EQ(Route("eth1 00000000 0 0003 0 0 100 00000000 0 0 0\n" + std::string(kDefault)), "eth1");
}

TEST(RouteTest, IsNoneIfTheTableRejectsItOrTheRouteIsDown) {
  EXPECT_EQ(Route(std::string(kDefault) + "* 000000E0 00000000 0201 0 0 0 000000F0 0 0 0\n"), "");
  EXPECT_EQ(Route("eth0 000000E0 00000000 0000 0 0 0 000000F0 0 0 0\n"), "");
}

constexpr char kSnmp[] =
    "Tcp: RtoAlgorithm RtoMin\nTcp: 1 200\n"
    "Udp: InDatagrams NoPorts InErrors OutDatagrams RcvbufErrors SndbufErrors\n"
    "Udp: 39155 17 4 40000 3 0\n"
    "UdpLite: InDatagrams RcvbufErrors\nUdpLite: 0 9\n";

TEST(FullBuffersTest, AreTheThirdOfUdpsErrors) {
  EXPECT_EQ(FullBuffers(kSnmp), 3u);
  EXPECT_EQ(FullBuffers("Udp: InDatagrams\nUdp: 5\n"), std::nullopt);
  EXPECT_EQ(FullBuffers("Udp: InDatagrams RcvbufErrors\nUdp: 5\n"), std::nullopt);
  EXPECT_EQ(FullBuffers(""), std::nullopt);
}

TEST(ClockWatchTest, TellsJumpsFromSlewing) {
  ClockWatch watch;
  double system = 1000;
  for (int i = 0; i < 100; ++i) {
    const double now = i * 0.002;
    watch.Note(now, system + 1e-6 * i, now + 1e-6);
    system += 0.002;
  }
  EXPECT_EQ(watch.course().steps, 0);
  system -= 0.5;
  watch.Note(0.2, system, 0.2 + 1e-6);
  watch.Note(0.202, system + 0.002, 0.202 + 1e-6);
  system += 0.01;
  watch.Note(0.204, system + 0.004, 0.204 + 1e-6);
  EXPECT_EQ(watch.course().steps, 2);
  EXPECT_NEAR(watch.course().largest, -0.5, 1e-3);
}

TEST(ClockWatchTest, LeavesOutAReadingThatWasInterrupted) {
  ClockWatch watch;
  watch.Note(0, 1000, 1e-6);
  watch.Note(1, 1001.05, 1.05);
  EXPECT_EQ(watch.course().steps, 0);
}

TEST(StatesWatchTest, GivesRateAndLongestPauseBetweenFirstAndLast) {
  StatesWatch watch(milliseconds(0));
  watch.Note(milliseconds(500));
  for (const int at : {502, 504, 506, 516, 518, 520}) watch.Note(milliseconds(at));
  const States states = watch.states();
  EXPECT_EQ(states.count, 7u);
  EXPECT_DOUBLE_EQ(states.rate, 6 / 0.020);
  EXPECT_DOUBLE_EQ(states.longest_pause, 0.010);
}

TEST(StatesWatchTest, GivesNoRateOfOne) {
  StatesWatch watch(milliseconds(0));
  EXPECT_EQ(watch.states().rate, 0);
  watch.Note(milliseconds(1));
  EXPECT_EQ(watch.states().rate, 0);
}

TEST(SpreadTest, IsByTheNearestRank) {
  std::vector<double> values;
  for (int i = 200; i > 0; --i) values.push_back(i);
  const Spread spread = SpreadOf(values);
  EXPECT_EQ(spread.count, 200u);
  EXPECT_EQ(spread.p50, 100);
  EXPECT_EQ(spread.p99, 198);
  EXPECT_EQ(spread.worst, 200);
  EXPECT_EQ(SpreadOf({7}).p50, 7);
  EXPECT_EQ(SpreadOf({7}).p99, 7);
  EXPECT_EQ(SpreadOf({}).count, 0u);
}

}  // namespace
}  // namespace understudy::doctor
