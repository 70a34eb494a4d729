// Reads MCAP files of any writer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/unique_fd.h"
#include "record/mcap_format.h"

namespace understudy::record {

struct McapAttachment {
  std::string name{};
  std::string media_type{};
  std::uint64_t log_time = 0;  // ns since 1970
  std::uint64_t offset = 0;    // of its record in the file
  std::uint64_t size = 0;      // of its data, bytes
};

// What a file contains besides the data of its messages.
struct McapContents {
  std::string profile{};
  std::string library{};
  std::map<std::uint16_t, McapSchema> schemas{};
  std::map<std::uint16_t, McapChannel> channels{};
  std::map<std::uint16_t, std::uint64_t> counts{};  // messages by channel
  std::uint64_t messages = 0;
  std::uint64_t first_time = 0, last_time = 0;  // of log times; 0 without messages
  std::vector<McapAttachment> attachments{};
  std::map<std::string, StringMap> metadata{};
  // "" for a complete file; else why it ends early. Everything before that point can be read.
  std::string cut_short{};
};

// Files may be damaged. A file that is not MCAP, a wrong length or checksum, or a chunk larger than
// it says throws RecordError with file and offset. A file without a complete summary, as a killed
// run leaves it, is scanned up to where it ends.
class McapReader {
 public:
  explicit McapReader(std::filesystem::path path);

  const McapContents& contents() const { return contents_; }
  const std::filesystem::path& path() const { return path_; }

  // Returns the schema of a channel; nullptr if it has none.
  const McapSchema* SchemaOf(const McapChannel& channel) const;

  // Calls visit(channel, message) with each message whose log time is in [from, to] (ns since 1970)
  // until visit returns false. Chunks come in order of time, messages of a chunk in file order. The
  // message's data is valid during the call. Throws RecordError.
  using Visit = std::function<bool(const McapChannel&, const McapMessage&)>;
  void ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const;
  void ReadMessages(const Visit& visit) const { ReadMessages(0, ~std::uint64_t{0}, visit); }

  // Returns the bytes of the first attachment of that name. Throws RecordError if there is none.
  std::vector<std::byte> ReadAttachment(std::string_view name) const;

 private:
  struct Record {
    McapOp op{};
    std::uint64_t offset = 0;  // of its first byte
    std::vector<std::byte> content;
  };
  struct Chunk {  // or, if `bare`, messages outside a chunk
    std::uint64_t first_time = 0, last_time = 0;
    std::uint64_t offset = 0;
    bool bare = false;
    bool empty = true;  // no message of it noted so far
  };

  std::vector<std::byte> Read(std::uint64_t offset, std::uint64_t size) const;
  Record ReadRecord(std::uint64_t offset) const;
  bool ReadSummary();
  bool Describes() const;
  void Scan(std::uint64_t begin);
  void Note(const Record& record, bool in_summary);
  void NoteInChunk(std::uint64_t offset, const std::vector<std::byte>& records, Chunk* chunk);
  void NoteMessage(const McapMessage& message, Chunk* chunk);
  [[noreturn]] void Fail(std::uint64_t offset, const std::string& what) const;

  std::filesystem::path path_;
  UniqueFd fd_;
  std::uint64_t size_ = 0;
  McapContents contents_;
  std::vector<Chunk> chunks_;
};

}  // namespace understudy::record
