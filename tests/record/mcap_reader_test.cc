#include <functional>
#include <sstream>

#include <gmock/gmock.h>
#include <zstd.h>

#include "tests/record/mcap_files.h"

namespace understudy::record {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

class McapReaderTest : public McapFilesTest {
 protected:
  // What reading such a file to its end comes to: "" when all of it could be read.
  std::string Reading(const std::string& text) const {
    try {
      const McapReader reader(Holding(text));
      MessagesOf(reader);
      for (const McapAttachment& attachment : reader.contents().attachments) {
        reader.ReadAttachment(attachment.name);
      }
      return reader.contents().cut_short;
    } catch (const RecordError& error) {
      return error.what();
    }
  }
  static std::string ChunkText(std::uint64_t size, std::uint32_t crc,
                               const std::string& compression, const std::string& records) {
    BytesOut chunk;
    chunk.Put(std::uint64_t{1});
    chunk.Put(std::uint64_t{2});
    chunk.Put(size);
    chunk.Put(crc);
    chunk.PutString(compression);
    chunk.Put(static_cast<std::uint64_t>(records.size()));
    chunk.PutRaw(AsBytes(records));
    return RecordText(McapOp::kChunk, chunk);
  }
  static std::string ChannelText() {
    BytesOut channel;
    channel.Put(std::uint16_t{1});
    channel.Put(std::uint16_t{0});
    channel.PutString("/a");
    channel.PutString("cdr");
    channel.PutMap({});
    return RecordText(McapOp::kChannel, channel);
  }
  static std::string MessageText(std::uint16_t channel, std::uint64_t time,
                                 const std::string& data = "data") {
    BytesOut message;
    message.Put(channel);
    message.Put(std::uint32_t{0});
    message.Put(time);
    message.Put(time);
    message.PutRaw(AsBytes(data));
    return RecordText(McapOp::kMessage, message);
  }
  // What may stand in a summary: how many messages of channel 1, between which times.
  static std::string StatisticsText(std::uint64_t messages, std::uint64_t first,
                                    std::uint64_t last) {
    BytesOut statistics;
    statistics.Put(messages);
    statistics.Put(std::uint16_t{0});
    for (int i = 0; i < 4; ++i) statistics.Put(std::uint32_t{0});
    statistics.Put(first);
    statistics.Put(last);
    statistics.Put(std::uint32_t{2 + 8});
    statistics.Put(std::uint16_t{1});
    statistics.Put(messages);
    return RecordText(McapOp::kStatistics, statistics);
  }
  static std::string ChunkIndexText(std::uint64_t first, std::uint64_t last, std::uint64_t offset,
                                    std::uint64_t size = 0) {
    BytesOut index;
    index.Put(first);
    index.Put(last);
    index.Put(offset);
    index.Put(size);
    return RecordText(McapOp::kChunkIndex, index);
  }
  // `summary` from byte `start` on; 0: there is none.
  static std::string EndText(const std::string& summary = "", std::uint64_t start = 0) {
    BytesOut end, footer;
    end.Put(std::uint32_t{0});
    if (start != 0) start += RecordText(McapOp::kDataEnd, end).size();
    footer.Put(start);
    footer.Put(std::uint64_t{0});
    footer.Put(std::uint32_t{0});
    return RecordText(McapOp::kDataEnd, end) + summary + RecordText(McapOp::kFooter, footer) +
           Magic();
  }
};

TEST_F(McapReaderTest, ReadsMessagesThatAreInNoChunk) {
  const McapReader reader(
      Holding(HeaderText() + ChannelText() + MessageText(1, 7) + MessageText(1, 8) + EndText()));
  EXPECT_EQ(reader.contents().cut_short, "");
  EXPECT_THAT(MessagesOf(reader), SizeIs(2));
  EXPECT_THAT(MessagesOf(reader, 8, 9), SizeIs(1));
}

TEST_F(McapReaderTest, ReadsChunksThatAreNotPacked) {
  const std::string records = ChannelText() + MessageText(1, 7);
  EXPECT_EQ(Reading(HeaderText() + ChunkText(records.size(), Crc32(AsBytes(records)), "", records) +
                    EndText()),
            "");
}

// As `Writer(repeat_channels=False)` of the MCAP project writes.
TEST_F(McapReaderTest, FindsChannelsThatTheSummaryDoesNotRepeat) {
  const std::string records = ChannelText() + MessageText(1, 7);
  const std::string front = HeaderText() + ChunkText(records.size(), 0, "", records);
  const std::string summary = StatisticsText(1, 7, 7) + ChunkIndexText(7, 7, HeaderText().size());
  const McapReader reader(Holding(front + EndText(summary, front.size())));
  EXPECT_EQ(reader.contents().cut_short, "");
  EXPECT_EQ(reader.contents().messages, 1U);
  EXPECT_THAT(MessagesOf(reader), SizeIs(1));
}

TEST_F(McapReaderTest, ReadsTimesFromZeroOn) {
  const std::string records = ChannelText() + MessageText(1, 0) + MessageText(1, 5);
  const McapReader reader(
      Holding(HeaderText() + ChunkText(records.size(), 0, "", records) + EndText()));
  EXPECT_THAT(MessagesOf(reader, 0, 3), SizeIs(1));
}

TEST_F(McapReaderTest, EndsWhereAPowerCutLeftZeros) {
  const McapReader reader(
      Holding(HeaderText() + ChannelText() + MessageText(1, 7) + std::string(10'000, '\0')));
  EXPECT_THAT(reader.contents().cut_short, HasSubstr("zeros"));
  EXPECT_THAT(MessagesOf(reader), SizeIs(1));
}

// As where a file system writes the length of a file before its pages.
TEST_F(McapReaderTest, LeavesOutAChunkThatAPowerCutDamaged) {
  const auto chunk = [](std::uint64_t time, bool damaged) {
    const std::string records = ChannelText() + MessageText(1, time);
    return ChunkText(records.size(), damaged ? 12345 : 0, "", records);
  };
  const McapReader amid(Holding(HeaderText() + chunk(1, false) + chunk(2, true) + chunk(3, false)));
  EXPECT_THAT(amid.contents().cut_short, HasSubstr("what it held is left out"));
  EXPECT_THAT(MessagesOf(amid), SizeIs(2));
  const McapReader last(
      Holding(HeaderText() + chunk(1, false) + chunk(2, true) + std::string(10'000, '\0')));
  EXPECT_THAT(last.contents().cut_short, HasSubstr("what it held is left out"));
  EXPECT_THAT(MessagesOf(last), SizeIs(1));
}

// A bad sector of a disk.
TEST_F(McapReaderTest, LeavesADamagedChunkOfAFinishedFileOutAndSaysSoOnceItIsRead) {
  const std::string one = ChannelText() + MessageText(1, 1), two = MessageText(1, 2),
                    three = MessageText(1, 3);
  const auto file = [&](const std::string& amid) {
    const std::string head = HeaderText() + ChunkText(one.size(), 0, "", one);
    const std::string last = ChunkText(three.size(), 0, "", three);
    const std::string summary = ChannelText() + ChunkIndexText(1, 1, HeaderText().size()) +
                                ChunkIndexText(2, 2, head.size()) +
                                ChunkIndexText(3, 3, head.size() + amid.size()) +
                                StatisticsText(3, 1, 3);
    const std::string data = head + amid + last;
    return data + EndText(summary, data.size());
  };
  const std::string whole = ChunkText(two.size(), 0, "", two);
  EXPECT_THAT(MessagesOf(McapReader(Holding(file(whole)))), SizeIs(3));
  const std::string wrong = ChunkText(two.size(), 12345, "", two);
  for (const std::string& amid : {wrong, std::string(wrong.size(), '\0')}) {
    const McapReader reader(Holding(file(amid)));
    EXPECT_EQ(reader.contents().cut_short, "") << "nobody has looked";
    EXPECT_THAT(MessagesOf(reader), SizeIs(2));
    EXPECT_THAT(reader.contents().cut_short, HasSubstr("what it held is left out"));
  }
  EXPECT_THAT(Reading(file(ChunkText(two.size(), 0, "lz4", two))), HasSubstr("packed with lz4"));
}

TEST_F(McapReaderTest, ReadsATimeOnly) {
  const std::vector<Kept> some = MessagesOf(McapReader(Written()), 104, 106);
  ASSERT_THAT(some, SizeIs(3));
  EXPECT_EQ(some.front().log_time, 104U);
  EXPECT_EQ(some.back().log_time, 106U);
}

TEST_F(McapReaderTest, StopsWhenTheVisitorHasEnough) {
  int seen = 0;
  McapReader(Written()).ReadMessages(
      [&](const McapChannel&, const McapMessage&) { return ++seen < 4; });
  EXPECT_EQ(seen, 4);
}

TEST_F(McapReaderTest, SaysThatAFileIsNotThere) {
  EXPECT_THAT([&] { McapReader reader(File("none.mcap")); },
              ThrowsMessage<RecordError>(HasSubstr("none.mcap: No such file")));
  EXPECT_THAT([&] { McapReader reader(folder_.path()); },
              ThrowsMessage<RecordError>(HasSubstr("is not a file")));
}

TEST_F(McapReaderTest, RefusesWhatIsNoMcap) {
  EXPECT_THAT(Reading(""), HasSubstr("is not an MCAP file"));
  EXPECT_THAT(Reading("rosbag #2.0"), HasSubstr("is not an MCAP file"));
  EXPECT_THAT(Reading(Magic()), HasSubstr("ends before its header"));
  EXPECT_THAT(Reading(Magic() + ChannelText()), HasSubstr("expected the header"));
}

TEST_F(McapReaderTest, RefusesAHeaderThatIsTooShort) {
  BytesOut header;
  header.Put(std::uint32_t{1000});
  EXPECT_THAT(Reading(Magic() + RecordText(McapOp::kHeader, header)),
              HasSubstr("at byte 8: expected 1000 bytes and found 0"));
}

TEST_F(McapReaderTest, EndsWhereARecordIsLongerThanTheFile) {
  BytesOut head;
  head.Put(static_cast<std::uint8_t>(McapOp::kMessage));
  head.Put(~std::uint64_t{0});
  EXPECT_THAT(Reading(HeaderText() + TextOf(head.span())),
              HasSubstr("a record of 18446744073709551615 bytes, of which the file holds 0"));
}

TEST_F(McapReaderTest, RefusesAChunkThatIsTooLargeToUnpack) {
  EXPECT_THAT(Reading(HeaderText() + ChunkText(std::uint64_t{1} << 40, 0, "zstd", "x")),
              HasSubstr("at most 268435456 are unpacked"));
}

TEST_F(McapReaderTest, RefusesAChunkThatUnpacksToMoreThanItSays) {
  const std::string large(1 << 20, 'x');
  std::string packed(ZSTD_compressBound(large.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), large.data(), large.size(), 1));
  EXPECT_THAT(Reading(HeaderText() + ChunkText(100, 0, "zstd", packed)),
              HasSubstr("a chunk does not unpack"));
  EXPECT_THAT(Reading(HeaderText() + ChunkText(large.size() + 1, 0, "zstd", packed)),
              HasSubstr("unpacks to 1048576 bytes, not 1048577"));
}

TEST_F(McapReaderTest, RefusesAChunkThatIsDamaged) {
  const std::string records = ChannelText() + MessageText(1, 7);
  EXPECT_THAT(Reading(HeaderText() + ChunkText(records.size(), 12345, "", records)),
              HasSubstr("a chunk's checksum is wrong"));
  EXPECT_THAT(Reading(HeaderText() + ChunkText(4, 0, "zstd", "junk")),
              HasSubstr("a chunk does not unpack"));
  EXPECT_THAT(Reading(HeaderText() + ChunkText(4, 0, "", "junk")), HasSubstr("expected"));
}

TEST_F(McapReaderTest, NamesACompressionThatItDoesNotKnow) {
  EXPECT_THAT(Reading(HeaderText() + ChunkText(4, 0, "lz4", "junk")),
              HasSubstr("packed with lz4; expected zstd"));
}

TEST_F(McapReaderTest, RefusesAMessageOfNoChannel) {
  EXPECT_THAT(Reading(HeaderText() + MessageText(3, 7) + EndText()),
              HasSubstr("a message of channel 3, which the file does not describe"));
}

TEST_F(McapReaderTest, RefusesAMessageThatIsTooShort) {
  BytesOut message;
  message.Put(std::uint16_t{1});
  EXPECT_THAT(Reading(HeaderText() + ChannelText() + RecordText(McapOp::kMessage, message)),
              HasSubstr("expected 4 bytes and found 0"));
}

TEST_F(McapReaderTest, RefusesASummaryThatLies) {
  const std::string whole = FileText(Written());
  std::string wrong = whole;
  wrong[whole.size() - 60] ^= 1;
  EXPECT_THAT(Reading(wrong), HasSubstr("the summary's checksum is wrong"));
  wrong = whole;
  const std::uint64_t beyond = whole.size() * 2;
  std::memcpy(wrong.data() + whole.size() - 28, &beyond, 8);
  EXPECT_THAT(Reading(wrong), HasSubstr("the footer has the summary begin at"));
}

TEST_F(McapReaderTest, RefusesChunksThatOverlap) {
  const std::string chunk = ChunkText(MessageText(1, 1).size(), 0, "", MessageText(1, 1));
  const std::uint64_t at = HeaderText().size();
  const auto with = [&](const std::string& indexes) {
    const std::string summary = ChannelText() + StatisticsText(1, 1, 2) + indexes;
    return Reading(HeaderText() + chunk + EndText(summary, at + chunk.size()));
  };
  const std::string index = ChunkIndexText(1, 2, at, chunk.size());
  EXPECT_EQ(with(index), "");
  EXPECT_THAT(with(index + index), HasSubstr("chunks that overlap"));
  EXPECT_THAT(with(index + ChunkIndexText(1, 2, at + 1, 5)), HasSubstr("chunks that overlap"));
  EXPECT_THAT(with(ChunkIndexText(1, 2, at, 9)), HasSubstr("larger than its index says"));
}

TEST_F(McapReaderTest, RefusesMetadataThatManyIndexesName) {
  BytesOut metadata, index;
  metadata.PutString("large");
  metadata.PutMap({{"text", std::string(2000, 'x')}});
  index.Put(static_cast<std::uint64_t>(HeaderText().size()));
  const std::string body = HeaderText() + RecordText(McapOp::kMetadata, metadata);
  std::string summary = StatisticsText(0, 0, 0);
  for (int i = 0; i < 3; ++i) summary += RecordText(McapOp::kMetadataIndex, index);
  EXPECT_THAT(Reading(body + EndText(summary, body.size())),
              HasSubstr("more metadata than the file has"));
}

TEST_F(McapReaderTest, RefusesAFileThatUnpacksToFarMoreThanItHas) {
  // One record of an unknown kind.
  std::string large(std::size_t{250} << 20, '\0');
  const std::uint64_t length = large.size() - 9;
  large[0] = '\x7f';
  std::memcpy(large.data() + 1, &length, 8);
  std::string packed(ZSTD_compressBound(large.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), large.data(), large.size(), 1));
  std::string text = HeaderText();
  for (int i = 0; i < 3; ++i) text += ChunkText(large.size(), 0, "zstd", packed);
  EXPECT_THAT(Reading(text), HasSubstr("the file unpacks to more than"));
}

TEST_F(McapReaderTest, RefusesARecordingThatEndsBeforeItBegins) {
  const std::string summary = ChannelText() + StatisticsText(0, 8, 7);
  EXPECT_THAT(Reading(HeaderText() + EndText(summary, HeaderText().size())),
              HasSubstr("its last message is before its first"));
}

TEST_F(McapReaderTest, RefusesAFooterThatIsTooShort) {
  std::string text = FileText(Written());
  const std::uint64_t few = 4;
  std::memcpy(text.data() + text.size() - 36, &few, 8);
  EXPECT_THAT(Reading(text), HasSubstr("made.mcap: at byte"));
}

TEST_F(McapReaderTest, RefusesAnAttachmentThatIsDamaged) {
  std::string wrong = FileText(Written());
  wrong[wrong.find("words")] = 'W';
  EXPECT_THAT(Reading(wrong), HasSubstr("the attachment's checksum is wrong"));
}

// Any one byte wrong anywhere: read or refused, in words, and never more than that.
TEST_F(McapReaderTest, SurvivesAnyWrongByte) {
  const std::string whole = FileText(Written(true, 4));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string text = whole;
    text[at] = static_cast<char>(~text[at]);
    ASSERT_EQ(Reading(text).find('\n'), std::string::npos);
  }
}

TEST_F(McapReaderTest, KnowsNoAttachmentThatIsNotThere) {
  const McapReader reader(Written());
  EXPECT_THAT([&] { reader.ReadAttachment("model.mjb"); },
              ThrowsMessage<RecordError>(HasSubstr("holds no attachment model.mjb")));
}

}  // namespace
}  // namespace understudy::record
