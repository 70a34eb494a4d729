#include <atomic>
#include <csignal>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/errors.h"
#include "bus/reader.h"
#include "bus/writer.h"
#include "tests/bus/stranger.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"

namespace understudy::bus {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Topic<Hello> kTopic{"rt/hello", &HelloWorldData_Msg_desc};

std::vector<std::int64_t> TakeIds(Reader<Hello>* reader, int max = kMaxTake) {
  std::vector<std::int64_t> ids;
  reader->Take([&](const Hello& hello, WriterHandle) { ids.push_back(hello.userID); }, max);
  return ids;
}

bool Send(const Entity& writer, std::int64_t id) {
  std::string text = "hello";
  const Hello hello{.userID = id, .message = text.data()};
  return dds_write(writer.handle(), &hello) == DDS_RETCODE_OK;
}

Hello Greeting(std::int64_t id) {
  static std::string text = "hello";
  return {.userID = id, .message = text.data()};
}

TEST(ReaderTest, FindsNothingBeforeTheFirstMessage) {
  const Participant ours("lo", test::NewDomain());
  Reader<Hello> reader(ours, kTopic);
  EXPECT_EQ(reader.matched_writers(), 0);
  EXPECT_THAT(TakeIds(&reader), IsEmpty());
}

TEST(ReaderTest, TakesOldestFirstAndEachOnce) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Reader<Hello> reader(ours, kTopic);
  const Stranger stranger(domain);
  const Entity writer = stranger.Writes(kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  for (const std::int64_t id : {1, 2, 3}) ASSERT_TRUE(Send(writer, id));
  EXPECT_THAT(TakeIds(&reader, 2), ElementsAre(1, 2));
  EXPECT_THAT(TakeIds(&reader), ElementsAre(3));
  EXPECT_THAT(TakeIds(&reader), IsEmpty());
}

TEST(ReaderTest, RingsABellForThoseWhoSleep) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  const Bell bell;
  Reader<Hello> reader(ours, kTopic, {.bell = &bell});
  const Stranger stranger(domain);
  const Entity writer = stranger.Writes(kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  EXPECT_FALSE(bell.Answer());
  ASSERT_TRUE(Send(writer, 1));
  EXPECT_TRUE(test::Eventually([&] { return bell.Answer(); }));
  EXPECT_THAT(TakeIds(&reader), ElementsAre(1));
}

TEST(ReaderTest, KeepsTheNewestOfItsDepth) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Reader<Hello> reader(ours, kTopic, {.depth = 2});
  const Stranger stranger(domain);
  const Entity writer = stranger.Writes(kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  for (const std::int64_t id : {1, 2, 3}) ASSERT_TRUE(Send(writer, id));
  EXPECT_THAT(TakeIds(&reader), ElementsAre(2, 3));
}

TEST(ReaderTest, CountsWhatNewerOnesReplaced) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Reader<Hello> reader(ours, kTopic, {.depth = 2});
  const Stranger stranger(domain);
  const Entity writer = stranger.Writes(kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  for (std::int64_t id = 0; id < 5; ++id) ASSERT_TRUE(Send(writer, id));
  EXPECT_THAT(TakeIds(&reader), ElementsAre(3, 4));
  EXPECT_EQ(reader.lost(), 3U);
  ASSERT_TRUE(Send(writer, 5));
  EXPECT_THAT(TakeIds(&reader), ElementsAre(5));
  EXPECT_EQ(reader.lost(), 3U);
}

TEST(ReaderTest, DropsWhatIsTooLongUnreadAndCountsIt) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Reader<Hello> reader(ours, kTopic, {.most_bytes = 100});
  const Stranger stranger(domain);
  const Entity writer = stranger.Writes(kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  std::string text(200, 'x');
  const Hello hello{.userID = 1, .message = text.data()};
  ASSERT_EQ(dds_write(writer.handle(), &hello), DDS_RETCODE_OK);
  ASSERT_TRUE(Send(writer, 2));
  EXPECT_THAT(TakeIds(&reader), ElementsAre(2));
  EXPECT_EQ(reader.undecoded(), 1U);
  EXPECT_EQ(reader.lost(), 0U);
}

TEST(ReaderTest, DecodesTextsOfAnyLengthOneAfterTheOther) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Reader<Hello> reader(ours, kTopic);
  const Stranger stranger(domain);
  const Entity writer = stranger.Writes(kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  for (const std::size_t length : {5U, 5000U, 0U, 40U}) {
    std::string text(length, 'x');
    const Hello hello{.userID = 1, .message = text.data()};
    ASSERT_EQ(dds_write(writer.handle(), &hello), DDS_RETCODE_OK);
    std::string read;
    ASSERT_EQ(reader.Take([&](const Hello& one, WriterHandle) { read = one.message; }), 1);
    EXPECT_EQ(read, text);
  }
}

TEST(ReaderTest, VisitsAtMostSixteenAtOnce) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Reader<Hello> reader(ours, kTopic, {.depth = 40});
  const Stranger stranger(domain);
  const Entity writer = stranger.Writes(kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  for (std::int64_t id = 0; id < 20; ++id) ASSERT_TRUE(Send(writer, id));
  EXPECT_EQ(TakeIds(&reader, 100).size(), 16);
  EXPECT_EQ(TakeIds(&reader, 100).size(), 4);
}

// Each message is sent once the one before has been seen: one that came unnoticed would end it.
TEST(ReaderTest, MissesNoMessageThatComesWhileItLooks) {
  const int domain = test::NewDomain();
  constexpr std::int64_t kMessages = 2000;
  const Participant ours("lo", domain);
  Reader<Hello> reader(ours, kTopic);
  const Stranger stranger(domain);
  const Entity writer = stranger.Writes(kTopic.name);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  std::atomic<std::int64_t> seen{0};
  const std::jthread sender([&](const std::stop_token& stop) {
    for (std::int64_t id = 1; id <= kMessages && !stop.stop_requested(); ++id) {
      Send(writer, id);
      while (seen < id && !stop.stop_requested()) std::this_thread::yield();
    }
  });
  EXPECT_TRUE(test::Eventually([&] {
    for (const std::int64_t id : TakeIds(&reader, 1)) seen = id;
    return seen == kMessages;
  }));
}

TEST(ReaderTest, AcceptsReliableAndBestEffortWritersOfBothRepresentations) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Reader<Hello> reader(ours, kTopic);
  const Stranger stranger(domain);
  const Entity cpp = stranger.Writes(kTopic.name);
  const Entity ros = stranger.Writes(kTopic.name, {.depth = 10});
  const Entity best_effort = stranger.Writes(kTopic.name, {.reliable = false});
  const Entity xcdr2 =
      stranger.Writes(kTopic.name, {.representation = DDS_DATA_REPRESENTATION_XCDR2});
  EXPECT_TRUE(test::Eventually([&] { return reader.matched_writers() == 4; }));
}

TEST(ReaderTest, TellsWhoseASampleIsWhileTheWriterLives) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Reader<Hello> reader(ours, kTopic, {.reliable = true});
  const Stranger stranger(domain);
  dds_guid_t guid{};
  ASSERT_EQ(dds_get_guid(stranger.handle(), &guid), DDS_RETCODE_OK);
  WriterHandle seen = 0;
  {
    const Entity writer = stranger.Writes(kTopic.name);
    ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
    ASSERT_TRUE(Send(writer, 1));
    ASSERT_EQ(reader.Take([&](const Hello&, WriterHandle handle) { seen = handle; }), 1);
    EXPECT_EQ(reader.ParticipantOf(seen), std::to_array(guid.v));
  }
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 0; }));
  EXPECT_EQ(reader.ParticipantOf(seen), std::nullopt);
}

TEST(ReaderTest, DoesNotVisitThatAWriterHasGone) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Reader<Hello> reader(ours, kTopic);
  const Stranger stranger(domain);
  {
    const Entity writer = stranger.Writes(kTopic.name);
    ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
    ASSERT_TRUE(Send(writer, 1));
    ASSERT_THAT(TakeIds(&reader), ElementsAre(1));
  }
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 0; }));
  EXPECT_THAT(TakeIds(&reader), IsEmpty());
}

TEST(ReaderTest, RefusesATypeOfAnotherSize) {
  const Participant ours("lo", test::NewDomain());
  const Topic<std::int64_t> wrong{"rt/hello", &HelloWorldData_Msg_desc};
  EXPECT_THROW(Reader<std::int64_t>(ours, wrong), BusError);
}

TEST(WriterTest, RefusesATypeOfAnotherSize) {
  const Participant ours("lo", test::NewDomain());
  const Topic<std::int64_t> wrong{"rt/hello", &HelloWorldData_Msg_desc};
  EXPECT_THROW(Writer<std::int64_t>(ours, wrong), BusError);
}

TEST(WriterTest, WritesWithoutAReader) {
  const Participant ours("lo", test::NewDomain());
  Writer<Hello> writer(ours, kTopic);
  EXPECT_EQ(writer.matched_readers(), 0);
  EXPECT_FALSE(writer.has_readers());
  EXPECT_TRUE(writer.Write(Greeting(1)));
}

TEST(WriterTest, SatisfiesReliableReadersOfXcdr1) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Writer<Hello> writer(ours, kTopic);
  const Stranger stranger(domain);
  const Entity reader = stranger.Reads(kTopic.name);
  EXPECT_TRUE(test::Eventually([&] { return writer.matched_readers() == 1; }));
}

TEST(WriterTest, KnowsWhileSomebodyReads) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Writer<Hello> writer(ours, kTopic);
  const Stranger stranger(domain);
  {
    const Entity reader = stranger.Reads(kTopic.name);
    EXPECT_TRUE(test::Eventually([&] { return writer.has_readers(); }));
  }
  EXPECT_TRUE(test::Eventually([&] { return !writer.has_readers(); }));
}

TEST(WriterTest, ReachesAParticipantOnceItsReaderIsMatched) {
  const int domain = test::NewDomain();
  const Participant ours("lo", domain);
  Writer<Hello> writer(ours, kTopic);
  const Stranger stranger(domain);
  dds_guid_t guid{};
  ASSERT_EQ(dds_get_guid(stranger.handle(), &guid), DDS_RETCODE_OK);
  EXPECT_FALSE(writer.ReachesParticipant(std::to_array(guid.v)));
  const Entity reader = stranger.Reads(kTopic.name);
  EXPECT_TRUE(test::Eventually([&] { return writer.ReachesParticipant(std::to_array(guid.v)); }));
  EXPECT_FALSE(writer.ReachesParticipant(ours.key()));
}

TEST(WriterTest, CountsRefusedMessages) {
  const Participant ours("lo", test::NewDomain());
  Writer<Hello> orphan = [&] {
    Writer<Hello> writer(ours, kTopic);
    Writer<Hello> other = std::move(writer);
    return other;
  }();
  EXPECT_TRUE(orphan.Write(Greeting(1)));
  Writer<Hello> taken = std::move(orphan);
  EXPECT_FALSE(orphan.Write(Greeting(2)));  // NOLINT(bugprone-use-after-move): its state is defined
}

// A program with a reliable reader, until the end of the scope. To be made before this process
// joins a domain: a fork carries no threads along.
class ReadingProgram {
 public:
  explicit ReadingProgram(int domain) : pid_(fork()) {
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const Entity network = JoinOverTheNetwork(domain, domain);
    const Stranger stranger(domain);
    const Entity reader = stranger.Reads(kTopic.name, {.depth = 0});
    for (;;) pause();
  }
  ~ReadingProgram() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  ReadingProgram(const ReadingProgram&) = delete;
  ReadingProgram& operator=(const ReadingProgram&) = delete;

  // Stops it as a debugger would: it neither acknowledges nor empties its socket any more.
  void Hang() {
    kill(pid_, SIGSTOP);
    waitpid(pid_, nullptr, WUNTRACED);
  }

 private:
  pid_t pid_;
};

TEST(WriterTest, IsNotHeldUpByAProgramThatHangs) {
  const int domain = test::NewDomain();
  ReadingProgram program(domain);
  const Participant ours("lo", domain);
  Writer<Hello> writer(ours, kTopic);
  ASSERT_TRUE(test::Eventually([&] { return writer.matched_readers() == 1; }));
  program.Hang();
  for (std::int64_t id = 0; id < 20000; ++id) ASSERT_TRUE(writer.Write(Greeting(id)));
  EXPECT_EQ(writer.matched_readers(), 1);
}

}  // namespace
}  // namespace understudy::bus
