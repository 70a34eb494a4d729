#include <string>

#include <gmock/gmock.h>
#include <unistd.h>

#include "bus/discovery.h"
#include "bus/writer.h"
#include "tests/bus/stranger.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"

namespace understudy::bus {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr Topic<Hello> kTopic{"rt/lowstate", &HelloWorldData_Msg_desc};

TEST(NeighbourWatchTest, SeesNobodyOnAnEmptyBus) {
  const Participant ours("lo", test::NewDomain());
  NeighbourWatch watch(ours, kTopic.name);
  EXPECT_THAT(watch.Poll(), IsEmpty());
}

TEST(NeighbourWatchTest, DoesNotReportOurselves) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  const Writer<Hello> writer(ours, kTopic);
  const Stranger stranger(domain);
  const Entity theirs = stranger.Writes(kTopic.name);
  NeighbourWatch watch(ours, kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return !watch.Poll().empty(); }));
  EXPECT_THAT(watch.Poll(), SizeIs(1));
  EXPECT_NE(watch.Poll().front().participant, ours.key());
}

TEST(NeighbourWatchTest, DoesNotReportWritersOfOtherTopics) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  const Stranger stranger(domain);
  const Entity other = stranger.Writes("rt/other");
  const Entity same = stranger.Writes(kTopic.name);
  NeighbourWatch watch(ours, kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return !watch.Poll().empty(); }));
  EXPECT_THAT(watch.Poll(), SizeIs(1));
}

TEST(NeighbourWatchTest, TellsTypeProcessAndParticipantAcrossTheNetwork) {
  const int domain = test::NewDomain();
  const int alias = test::NewDomain();
  const Participant ours("lo", domain);
  NeighbourWatch watch(ours, kTopic.name);
  const Entity network = JoinOverTheNetwork(domain, alias);
  const Stranger stranger(alias);
  const Entity writer = stranger.Writes(kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return watch.Poll().size() == 1; }));
  const Neighbour& neighbour = watch.Poll().front();
  dds_guid_t guid{};
  ASSERT_EQ(dds_get_guid(stranger.handle(), &guid), DDS_RETCODE_OK);
  EXPECT_EQ(neighbour.participant, std::to_array(guid.v));
  EXPECT_EQ(neighbour.type, "HelloWorldData::Msg");
  EXPECT_EQ(neighbour.pid, std::to_string(getpid()));
  EXPECT_NE(neighbour.host, "");
  EXPECT_THAT(Describe(neighbour), ::testing::StartsWith("process " + neighbour.pid));
}

TEST(NeighbourWatchTest, ForgetsAWriterThatHasGone) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  NeighbourWatch watch(ours, kTopic.name);
  const Stranger stranger(domain);
  {
    const Entity writer = stranger.Writes(kTopic.name);
    ASSERT_TRUE(test::Eventually([&] { return watch.Poll().size() == 1; }));
  }
  EXPECT_TRUE(test::Eventually([&] { return watch.Poll().empty(); }));
}

TEST(NeighbourTest, IsDescribedByWhatIsKnown) {
  EXPECT_EQ(Describe(Neighbour{}), "a participant");
  EXPECT_EQ(Describe(Neighbour{
                .host = "robot", .process = "ai_sport", .pid = "7", .addresses = "192.0.2.1"}),
            "process 7 (ai_sport) on robot (192.0.2.1)");
}

}  // namespace
}  // namespace understudy::bus
