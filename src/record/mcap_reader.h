// Reads MCAP, of any writer.
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
  std::uint64_t offset = 0;    // of its record
  std::uint64_t size = 0;      // bytes of its data
};

// What a file holds, before any message is read.
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
  // "" for a file that was finished; else why it ends where it does. What stands before that is
  // all there.
  std::string cut_short{};
};

// A file need not be sound: whatever is wrong with it (no MCAP, lengths that lie, checksums that do
// not fit, chunks that unpack to more than they say) ends in a RecordError that names file and
// place. A file without a whole summary, as a killed run leaves it, is read through to where it
// breaks off.
class McapReader {
 public:
  explicit McapReader(std::filesystem::path path);

  const McapContents& contents() const { return contents_; }
  const std::filesystem::path& path() const { return path_; }

  // The schema of a channel; nullptr where it has none.
  const McapSchema* SchemaOf(const McapChannel& channel) const;

  // Calls visit(channel, message) with every message whose log time is in [from, to], chunk by
  // chunk in order of time, within a chunk as they stand; its data is gone after the call. Until
  // visit says false. Throws RecordError.
  using Visit = std::function<bool(const McapChannel&, const McapMessage&)>;
  void ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const;
  void ReadMessages(const Visit& visit) const { ReadMessages(0, ~std::uint64_t{0}, visit); }

  // The bytes of the first attachment of that name. Throws RecordError when there is none.
  std::vector<std::byte> ReadAttachment(std::string_view name) const;

 private:
  struct Record {
    McapOp op{};
    std::uint64_t offset = 0;  // of its head
    std::vector<std::byte> content;
  };
  struct Chunk {  // or messages outside of one: `bare`
    std::uint64_t first_time = 0, last_time = 0;
    std::uint64_t offset = 0;
    bool bare = false;
    bool empty = true;  // no message of it was noted (yet)
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
