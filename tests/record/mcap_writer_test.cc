#include <gmock/gmock.h>

#include "tests/record/mcap_files.h"

namespace understudy::record {
namespace {

using ::testing::EndsWith;
using ::testing::Pair;
using ::testing::SizeIs;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

using McapWriterTest = McapFilesTest;

TEST_F(McapWriterTest, WritesAFileWithoutMessagesByteForByte) {
  McapWriter writer(OutputFile(File(), false), "p", "lib");
  writer.Finish();
  const std::string text = FileText(File());
  const std::string header("\x01\x0C\0\0\0\0\0\0\0\x01\0\0\0p\x03\0\0\0lib", 21);
  EXPECT_THAT(text, StartsWith(Magic() + header + "\x0F"));
  EXPECT_THAT(text, EndsWith(Magic()));
  // Header, data end, statistics, summary offset, footer, magic.
  EXPECT_EQ(text.size(), 8 + 21 + 13 + (9 + 46) + (9 + 17) + (9 + 20) + 8);
}

TEST_F(McapWriterTest, KnowsTheChecksumOfTheFormat) {
  EXPECT_EQ(Crc32(AsBytes("123456789")), 0xCBF43926U);
  EXPECT_EQ(Crc32(AsBytes("6789"), Crc32(AsBytes("12345"))), 0xCBF43926U);
}

TEST_F(McapWriterTest, SaysInTheSummaryWhatIsInTheFile) {
  const McapReader reader(Written());
  const McapContents& contents = reader.contents();
  EXPECT_EQ(contents.cut_short, "");
  EXPECT_EQ(contents.profile, "ros2");
  EXPECT_EQ(contents.library, "a test");
  EXPECT_EQ(contents.messages, 10U);
  EXPECT_THAT(contents.counts, UnorderedElementsAre(Pair(1, 5U), Pair(2, 5U)));
  EXPECT_EQ(contents.first_time, 100U);
  EXPECT_EQ(contents.last_time, 109U);
  EXPECT_EQ(contents.schemas.at(1).data, "int32 a\n");
  EXPECT_EQ(contents.channels.at(1).metadata.at("from"), "robot");
  EXPECT_EQ(contents.metadata.at("about").at("robot"), "go2");
  ASSERT_THAT(contents.attachments, SizeIs(1));
  EXPECT_EQ(TextOf(reader.ReadAttachment("note.txt")), "words");
}

TEST_F(McapWriterTest, NumbersTheMessagesOfEachChannel) {
  const std::vector<Kept> messages = MessagesOf(McapReader(Written()));
  ASSERT_THAT(messages, SizeIs(10));
  EXPECT_EQ(messages[0], (Kept{"/a", 0, 100, 1000, "message 0"}));
  EXPECT_EQ(messages[1], (Kept{"/b", 0, 101, 1001, "message 1"}));
  EXPECT_EQ(messages[9], (Kept{"/b", 4, 109, 1009, "message 9"}));
}

TEST_F(McapWriterTest, LeavesAReadableFileWithoutItsEnd) {
  const McapReader reader(Written(false));
  EXPECT_EQ(reader.contents().cut_short, "its end is missing");
  EXPECT_EQ(reader.contents().messages, 10U);
  EXPECT_EQ(reader.contents().metadata.at("about").at("robot"), "go2");
  EXPECT_EQ(TextOf(reader.ReadAttachment("note.txt")), "words");
  EXPECT_THAT(MessagesOf(reader), SizeIs(10));
}

// The same file whatever was cut off: messages of whole chunks, never a wrong one.
TEST_F(McapWriterTest, LeavesWholeChunksWhereverItIsCut) {
  const std::string whole = FileText(Written(true, 7));
  const std::vector<Kept> all = MessagesOf(McapReader(File()));
  std::size_t most = 0;
  for (std::size_t size = HeaderText().size(); size < whole.size(); ++size) {
    const McapReader reader(Holding(whole.substr(0, size)));
    const std::vector<Kept> kept = MessagesOf(reader);
    ASSERT_LE(kept.size(), all.size());
    ASSERT_TRUE(std::equal(kept.begin(), kept.end(), all.begin())) << "cut at " << size;
    most = std::max(most, kept.size());
  }
  EXPECT_EQ(most, all.size());
}

TEST_F(McapWriterTest, FlushesByItselfWhenAChunkIsFull) {
  McapWriter writer(OutputFile(File(), false), "", "a test", {.chunk_bytes = 1000});
  const auto channel = writer.AddChannel("/a", 0, "cdr", {});
  const std::uint64_t before = writer.bytes();
  writer.Write(channel, 1, 1, AsBytes(std::string(900, 'x')));
  EXPECT_EQ(writer.bytes(), before);
  writer.Write(channel, 2, 2, AsBytes(std::string(900, 'y')));
  EXPECT_GT(writer.bytes(), before);
  EXPECT_EQ(writer.messages(), 2U);
}

}  // namespace
}  // namespace understudy::record
