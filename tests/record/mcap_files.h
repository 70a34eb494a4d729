// Makes small valid and invalid MCAP files.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "record/mcap_reader.h"
#include "record/mcap_writer.h"
#include "tests/support/temporary_folder.h"

namespace understudy::record {

// A message as the tests compare it.
struct Kept {
  std::string topic;
  std::uint32_t sequence;
  std::uint64_t log_time, publish_time;
  std::string data;

  friend bool operator==(const Kept&, const Kept&) = default;
};

inline std::string TextOf(ByteSpan bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline std::vector<Kept> MessagesOf(const McapReader& reader, std::uint64_t from = 0,
                                    std::uint64_t to = ~std::uint64_t{0}) {
  std::vector<Kept> messages;
  reader.ReadMessages(from, to, [&](const McapChannel& channel, const McapMessage& message) {
    messages.push_back({channel.topic, message.sequence, message.log_time, message.publish_time,
                        TextOf(message.data)});
    return true;
  });
  return messages;
}

inline std::string FileText(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The pieces of a file, to be put together wrongly.
inline std::string Magic() { return {reinterpret_cast<const char*>(kMcapMagic.data()), 8}; }
inline std::string RecordText(McapOp op, const BytesOut& content) {
  BytesOut out;
  out.Put(static_cast<std::uint8_t>(op));
  out.Put(static_cast<std::uint64_t>(content.size()));
  out.PutRaw(content.span());
  return TextOf(out.span());
}
inline std::string HeaderText() {
  BytesOut header;
  header.PutString("ros2");
  header.PutString("a test");
  return Magic() + RecordText(McapOp::kHeader, header);
}

class McapFilesTest : public testing::Test {
 protected:
  std::filesystem::path File(const std::string& name = "run.mcap") const {
    return folder_.path() / name;
  }
  // Two channels, a chunk per three messages, an attachment, metadata. Finished if asked.
  std::filesystem::path Written(bool finished = true, std::uint64_t messages = 10) {
    McapWriter writer(OutputFile(File(), true), "ros2", "a test", {.chunk_bytes = 200});
    writer.AddMetadata("about", {{"robot", "go2"}});
    writer.Attach("note.txt", "text/plain", 5, AsBytes("words"));
    const auto schema = writer.AddSchema("a_msgs/msg/A", "ros2msg", "int32 a\n");
    const auto a = writer.AddChannel("/a", schema, "cdr", {{"from", "robot"}});
    const auto b = writer.AddChannel("/b", schema, "cdr", {});
    for (std::uint64_t i = 0; i < messages; ++i) {
      writer.Write(i % 2 == 0 ? a : b, 100 + i, 1000 + i, AsBytes("message " + std::to_string(i)));
    }
    if (finished) {
      writer.Finish();
    } else {
      writer.Flush();
    }
    return File();
  }
  std::filesystem::path Holding(const std::string& text) const {
    return folder_.Write("made.mcap", text);
  }

  test::TemporaryFolder folder_;
};

}  // namespace understudy::record
