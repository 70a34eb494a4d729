// Tests reading and writing serialized messages.
#include "bus/cdr.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "bus/discovery.h"
#include "bus/now.h"
#include "bus/reader.h"
#include "bus/writer.h"
#include "tests/bus/stranger.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"

namespace understudy::bus {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr Topic<Hello> kTopic{"rt/hello", &HelloWorldData_Msg_desc};

std::vector<std::string> Bytes(CdrReader* reader) {
  std::vector<std::string> all;
  reader->Take([&](const CdrSample& sample) {
    all.emplace_back(reinterpret_cast<const char*>(sample.bytes().data()), sample.bytes().size());
  });
  return all;
}

std::span<const std::byte> Raw(const std::string& text) { return std::as_bytes(std::span(text)); }

// {7, "hey"} little-endian, after the head.
const std::string kHey("\0\1\0\0\7\0\0\0\0\0\0\0\4\0\0\0hey\0", 20);

TEST(CdrReaderTest, HasTheBytesOfTheWire) {
  const Participant ours("lo", test::NewDomain());
  CdrReader reader(ours, kTopic.name, *kTopic.descriptor);
  Writer<Hello> writer(ours, kTopic);
  std::string text = "hey";
  ASSERT_TRUE(writer.Write({.userID = 7, .message = text.data()}));
  EXPECT_THAT(Bytes(&reader), ElementsAre(kHey));
  EXPECT_THAT(Bytes(&reader), IsEmpty());
}

TEST(CdrReaderTest, KeepsAllUntilItIsTaken) {
  const Participant ours("lo", test::NewDomain());
  CdrReader reader(ours, kTopic.name, *kTopic.descriptor);
  Writer<Hello> writer(ours, kTopic);
  std::string text = "hey";
  for (std::int64_t id = 0; id < 1000; ++id) {
    ASSERT_TRUE(writer.Write({.userID = id, .message = text.data()}));
  }
  EXPECT_THAT(Bytes(&reader), SizeIs(1000));
}

TEST(CdrReaderTest, TellsWhoseAMessageIs) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  CdrReader reader(ours, kTopic.name, *kTopic.descriptor);
  Writer<Hello> writer(ours, kTopic);
  std::string text = "hey";
  const Hello hello{.userID = 7, .message = text.data()};
  const Stranger stranger(domain);
  const Entity theirs = stranger.Writes(kTopic.name);
  ASSERT_EQ(dds_write(theirs.handle(), &hello), DDS_RETCODE_OK);
  ASSERT_TRUE(writer.Write(hello));
  std::vector<bool> is_ours;
  reader.Take([&](const CdrSample& sample) {
    is_ours.push_back(reader.ParticipantOf(sample.writer()) == ours.key());
  });
  EXPECT_THAT(is_ours, ElementsAre(false, true));
}

TEST(CdrReaderTest, HasTheTimeOfArrivalOfMessagesWithoutATimestamp) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  CdrReader reader(ours, kTopic.name, *kTopic.descriptor);
  const Stranger stranger(domain);
  const Entity theirs = stranger.Writes(kTopic.name);
  std::string text = "hey";
  const Hello hello{.userID = 7, .message = text.data()};
  std::vector<std::int64_t> between = {Now().count()};
  for (const dds_time_t stamp : {0, 0, 5}) {
    ASSERT_EQ(dds_write_ts(theirs.handle(), &hello, stamp), DDS_RETCODE_OK);
    between.push_back(Now().count());
  }
  std::vector<std::int64_t> times;
  reader.Take([&](const CdrSample& sample) { times.push_back(sample.source_time()); });
  ASSERT_THAT(times, SizeIs(3));
  EXPECT_TRUE(between[0] <= times[0] && times[0] <= between[1]);
  EXPECT_TRUE(between[1] <= times[1] && times[1] <= between[2]);
  EXPECT_EQ(times[2], 5);
}

TEST(CdrReaderTest, DoesNotTellThatAWriterHasGone) {
  const Participant ours("lo", test::NewDomain());
  CdrReader reader(ours, kTopic.name, *kTopic.descriptor);
  { const Writer<Hello> writer(ours, kTopic); }
  EXPECT_THAT(Bytes(&reader), IsEmpty());
}

TEST(CdrWriterTest, SendsTheBytesAsAMessage) {
  const Participant ours("lo", test::NewDomain());
  Reader<Hello> reader(ours, kTopic);
  CdrWriter writer(ours, kTopic.name, *kTopic.descriptor);
  EXPECT_EQ(writer.matched_readers(), 1);
  ASSERT_TRUE(writer.Write(Raw(kHey)));
  const std::string big_endian("\0\0\0\0\0\0\0\0\0\0\0\x8\0\0\0\4you\0", 20);
  ASSERT_TRUE(writer.Write(Raw(big_endian)));
  std::vector<std::string> heard;
  reader.Take([&](const Hello& hello, WriterHandle) {
    heard.push_back(std::to_string(hello.userID) + hello.message);
  });
  EXPECT_THAT(heard, ElementsAre("7hey", "8you"));
}

TEST(CdrWriterTest, RefusesBytesThatAreNoMessage) {
  const Participant ours("lo", test::NewDomain());
  CdrReader reader(ours, kTopic.name, *kTopic.descriptor);
  CdrWriter writer(ours, kTopic.name, *kTopic.descriptor);
  for (std::size_t size = 0; size < kHey.size(); ++size) {
    EXPECT_FALSE(writer.Write(Raw(kHey.substr(0, size)))) << size;
  }
  std::string wrong = kHey;
  wrong[12] = '\xFF';  // the text's length
  EXPECT_FALSE(writer.Write(Raw(wrong)));
  wrong = kHey;
  wrong[1] = 3;  // a parameter list
  EXPECT_FALSE(writer.Write(Raw(wrong)));
  EXPECT_THAT(Bytes(&reader), IsEmpty());
}

TEST(EndpointWatchTest, FindsOurOwnTopicsAndWhatOthersWrite) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  const Writer<Hello> writer(ours, {"rt/ours", &HelloWorldData_Msg_desc});
  const Reader<Hello> reader(ours, {"rt/in", &HelloWorldData_Msg_desc});
  EndpointWatch watch(ours);
  const auto topic = [](const std::string& name) {
    return TopicOnBus{.topic = name, .type = "HelloWorldData::Msg"};
  };
  EXPECT_THAT(watch.Poll(), ElementsAre(topic("rt/ours"), topic("rt/in")));
  EXPECT_THAT(watch.Poll(), IsEmpty());

  const Stranger stranger(domain);
  const Entity theirs = stranger.Writes("rt/theirs");
  const Entity ear = stranger.Reads("rt/ear");
  const std::vector<TopicOnBus> found = watch.Poll();
  EXPECT_THAT(found, Contains(topic("rt/theirs")));
  EXPECT_THAT(found, Not(Contains(topic("rt/ear"))));
}

}  // namespace
}  // namespace understudy::bus
