#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <unistd.h>

#include "bus/discovery.h"
#include "bus/reader.h"
#include "bus/writer.h"
#include "tests/bus/stranger.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"

namespace understudy::bus {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

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

TEST(AnnouncementWatchTest, TellsWhatOthersAnnounceUntilTheyHaveGone) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain, "us");
  AnnouncementWatch watch(ours);
  const Stranger says_nothing(domain);
  {
    const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(),
                                                                    &dds_delete_qos);
    dds_qset_userdata(qos.get(), "them", 4);
    const Entity other(
        dds_create_participant(static_cast<dds_domainid_t>(domain), qos.get(), nullptr), "join");
    ASSERT_TRUE(test::Eventually([&] { return !watch.Poll().empty(); }));
    ASSERT_THAT(watch.Poll(), SizeIs(1));
    EXPECT_EQ(watch.Poll().front().text, "them");
    dds_guid_t guid{};
    ASSERT_EQ(dds_get_guid(other.handle(), &guid), DDS_RETCODE_OK);
    EXPECT_EQ(watch.Poll().front().participant, std::to_array(guid.v));
  }
  EXPECT_TRUE(test::Eventually([&] { return watch.Poll().empty(); }));
}

class MismatchWatchTest : public ::testing::Test {
 protected:
  // What is told within a second of the watch's clock, and a little of ours for discovery.
  std::vector<Mismatch> Told() {
    std::vector<Mismatch> told;
    test::Eventually(
        [&] {
          now_ += std::chrono::milliseconds(100);
          for (Mismatch& one : watch_.Poll(now_)) told.push_back(std::move(one));
          return !told.empty();
        },
        std::chrono::milliseconds(500));
    return told;
  }
  Entity WriterOf(const dds_topic_descriptor& type, const dds_qos_t* qos) const {
    return Entity(dds_create_writer(
                      stranger_.handle(),
                      dds_create_topic(stranger_.handle(), &type, kTopic.name, nullptr, nullptr),
                      qos, nullptr),
                  "write");
  }

  const int domain_ = test::NewDomain();
  const Participant ours_{"lo", domain_};
  const Reader<Hello> reader_{ours_, kTopic};
  MismatchWatch watch_{ours_, {&reader_}};
  const Stranger stranger_{domain_};
  std::chrono::nanoseconds now_{0};
};

TEST_F(MismatchWatchTest, SaysNothingOfAWriterThatMatches) {
  const Entity writer = stranger_.Writes(kTopic.name);
  EXPECT_THAT(Told(), IsEmpty());
}

TEST_F(MismatchWatchTest, NamesAnotherType) {
  const dds_topic_descriptor_t& hello = HelloWorldData_Msg_desc;
  const dds_topic_descriptor_t other{
      .m_size = hello.m_size,
      .m_align = hello.m_align,
      .m_flagset = hello.m_flagset & ~static_cast<std::uint32_t>(DDS_TOPIC_XTYPES_METADATA),
      .m_nkeys = hello.m_nkeys,
      .m_typename = "Hello.World\nData_",
      .m_keys = hello.m_keys,
      .m_nops = hello.m_nops,
      .m_ops = hello.m_ops,
      .m_meta = hello.m_meta,
      .type_information = {},
      .type_mapping = {},
      .restrict_data_representation = hello.restrict_data_representation};
  const Entity writer = WriterOf(other, nullptr);
  const std::vector<Mismatch> told = Told();
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].topic, kTopic.name);
  EXPECT_EQ(told[0].why, "type Hello.World?Data_");
  EXPECT_THAT(Told(), IsEmpty());
}

TEST_F(MismatchWatchTest, NamesAPartition) {
  const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(),
                                                                  &dds_delete_qos);
  const char* partitions[] = {"robots", "b"};
  dds_qset_partition(qos.get(), 2, partitions);
  const Entity writer = WriterOf(HelloWorldData_Msg_desc, qos.get());
  const std::vector<Mismatch> told = Told();
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].why, "partition \"robots\", \"b\"");
}

TEST_F(MismatchWatchTest, NamesThePolicy) {
  const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(),
                                                                  &dds_delete_qos);
  dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);
  const Entity writer = WriterOf(HelloWorldData_Msg_desc, qos.get());
  const std::vector<Mismatch> told = Told();
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].why, "ownership");
}

TEST(MismatchTest, HasItsReasonInALineHoweverLongTheProcessIsCalled) {
  const Mismatch mismatch{.topic = "rt/lowcmd",
                          .why = "ownership",
                          .writer = {.process = std::string(500, 'p'), .pid = "7"}};
  EXPECT_EQ(Describe(mismatch), "rt/lowcmd by process 7 (" + std::string(32, 'p') + "): ownership");
}

TEST(NeighbourTest, IsDescribedByWhatIsKnown) {
  EXPECT_EQ(Describe(Neighbour{}), "a participant");
  EXPECT_EQ(Describe(Neighbour{
                .host = "robot", .process = "ai_sport", .pid = "7", .addresses = "192.0.2.1"}),
            "process 7 (ai_sport) on robot (192.0.2.1)");
}

TEST(EndpointSurveyTest, TellsWhatOthersReadAndWriteAndWithWhichQuality) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  const Writer<Hello> own(ours, kTopic);
  EndpointSurvey survey(ours);
  const Stranger stranger(domain);
  const Entity writer = stranger.Writes(
      "rt/lowcmd", {.reliable = false, .representation = DDS_DATA_REPRESENTATION_XCDR2});
  const Entity reader = stranger.Reads("rt/lowstate");
  ASSERT_TRUE(test::Eventually([&] {
    survey.Poll();
    return survey.endpoints().size() == 2;
  }));
  const bool first = survey.endpoints().front().writes;
  const Endpoint& writes = survey.endpoints()[first ? 0 : 1];
  const Endpoint& reads = survey.endpoints()[first ? 1 : 0];
  EXPECT_EQ(writes.topic, "rt/lowcmd");
  EXPECT_TRUE(writes.writes);
  EXPECT_FALSE(writes.reliable);
  EXPECT_FALSE(writes.xcdr1);
  EXPECT_EQ(reads.topic, "rt/lowstate");
  EXPECT_FALSE(reads.writes);
  EXPECT_TRUE(reads.reliable);
  EXPECT_TRUE(reads.xcdr1);
  for (const Endpoint& one : survey.endpoints()) {
    EXPECT_EQ(one.who.type, "HelloWorldData::Msg");
    EXPECT_EQ(one.definition, "");  // its IDL was compiled without
    EXPECT_EQ(one.who.pid, std::to_string(getpid()));
    EXPECT_FALSE(one.keeps_for_late || one.exclusive || one.has_deadline);
    EXPECT_EQ(one.partitions, "");
  }
  EXPECT_THAT(survey.participants(), SizeIs(1));
}

TEST(EndpointSurveyTest, TellsEachPolicyThatKeepsEndpointsApart) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  EndpointSurvey survey(ours);
  const Stranger stranger(domain);
  const auto qos = StrangerQos{}.Make();
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);
  dds_qset_deadline(qos.get(), DDS_SECS(1));
  const char* partition = "left";
  dds_qset_partition(qos.get(), 1, &partition);
  // A partition is a publisher's.
  const Entity publisher(dds_create_publisher(stranger.handle(), qos.get(), nullptr), "publish");
  const Entity topic(
      dds_create_topic(stranger.handle(), &HelloWorldData_Msg_desc, "rt/lowcmd", nullptr, nullptr),
      "create a topic");
  const Entity writer(dds_create_writer(publisher.handle(), topic.handle(), qos.get(), nullptr),
                      "write");
  ASSERT_TRUE(test::Eventually([&] {
    survey.Poll();
    return survey.endpoints().size() == 1;
  }));
  const Endpoint& one = survey.endpoints().front();
  EXPECT_TRUE(one.keeps_for_late);
  EXPECT_TRUE(one.exclusive);
  EXPECT_TRUE(one.has_deadline);
  EXPECT_EQ(one.partitions, "\"left\"");
}

TEST(EndpointSurveyTest, TellsWhatWeReadAndWriteAtOnceIfItIsAsked) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  const Writer<Hello> writer(ours, kTopic);
  const Reader<Hello> reader(ours, kTopic);
  EndpointSurvey survey(ours, SurveyOf::kAll);
  survey.Poll();
  ASSERT_THAT(survey.endpoints(), SizeIs(2));
  for (const Endpoint& one : survey.endpoints()) {
    EXPECT_TRUE(one.ours);
    EXPECT_EQ(one.topic, kTopic.name);
    EXPECT_EQ(one.reliable, one.writes);  // as a robot's
  }
  EndpointSurvey of_others(ours);
  of_others.Poll();
  EXPECT_THAT(of_others.endpoints(), SizeIs(0));
}

TEST(WhyNotMatchedTest, NamesWhatKeepsAWriterFromAReader) {
  const Endpoint reader{.topic = "rt/x", .who = {.type = "A"}};
  const Endpoint writer{.topic = "rt/x", .writes = true, .reliable = true, .who = {.type = "A"}};
  EXPECT_EQ(WhyNotMatched(writer, reader), "");
  Endpoint other = writer;
  other.who.type = "B";
  EXPECT_EQ(WhyNotMatched(other, reader), "type B, not A");
  other = writer;
  other.definition = "[MINIMAL 01]";
  EXPECT_EQ(WhyNotMatched(other, reader), "");  // which tells none
  Endpoint strange = reader;
  strange.definition = "[MINIMAL 02]";
  EXPECT_EQ(WhyNotMatched(other, strange), "each has another definition of A");
  other = writer;
  other.partitions = "\"left\"";
  EXPECT_EQ(WhyNotMatched(other, reader), "partition: \"left\", not none");
  other = writer;
  other.exclusive = true;
  EXPECT_THAT(WhyNotMatched(other, reader), StartsWith("ownership"));

  // What a reader wants more than a writer offers; that it offers more does no harm.
  const auto wants = [](bool Endpoint::*what) {
    Endpoint one{.topic = "rt/x", .who = {.type = "A"}};
    one.*what = true;
    return one;
  };
  const Endpoint plain{.topic = "rt/x", .writes = true, .who = {.type = "A"}};
  EXPECT_THAT(WhyNotMatched(plain, wants(&Endpoint::reliable)), StartsWith("reliability"));
  EXPECT_EQ(WhyNotMatched(writer, wants(&Endpoint::reliable)), "");
  EXPECT_THAT(WhyNotMatched(plain, wants(&Endpoint::keeps_for_late)), StartsWith("durability"));
  EXPECT_THAT(WhyNotMatched(plain, wants(&Endpoint::has_deadline)), StartsWith("deadline"));
  for (auto what : {&Endpoint::keeps_for_late, &Endpoint::has_deadline}) {
    other = plain;
    other.*what = true;
    EXPECT_EQ(WhyNotMatched(other, reader), "");
    EXPECT_EQ(WhyNotMatched(other, wants(what)), "");
  }
  other = reader;
  other.xcdr1 = false;
  EXPECT_THAT(WhyNotMatched(plain, other), StartsWith("data representation"));
}

TEST(TrafficTest, CountsWhatAParticipantSendsAndReceivesByTopic) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Writer<Hello> writer(ours, kTopic);
  Reader<Hello> reader(ours, kTopic);
  ASSERT_TRUE(test::Eventually([&] { return writer.has_readers(); }));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(writer.Write(Hello{}));
  ASSERT_TRUE(test::Eventually([&] {
    reader.Take([](const Hello&, WriterHandle) {});
    return ours.traffic().Read()[kTopic.name].received == 3;
  }));
  EXPECT_EQ(ours.traffic().Read()[kTopic.name].sent, 3u);
}

TEST(EndpointSurveyTest, ForgetsWhoHasGone) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  EndpointSurvey survey(ours);
  {
    const Stranger stranger(domain);
    const Entity writer = stranger.Writes("rt/lowcmd");
    ASSERT_TRUE(test::Eventually([&] {
      survey.Poll();
      return survey.endpoints().size() == 1;
    }));
  }
  ASSERT_TRUE(test::Eventually([&] {
    survey.Poll();
    return survey.endpoints().empty() && survey.participants().empty();
  }));
}

}  // namespace
}  // namespace understudy::bus
