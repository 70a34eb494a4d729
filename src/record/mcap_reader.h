// Reads MCAP files of any writer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/unique_fd.h"
#include "record/mcap_format.h"
#include "record/recording_reader.h"

namespace understudy::record {

// Files may be damaged. A chunk that is (ChunkDamage) is left out, and contents().cut_short says
// so. A file that is not MCAP, or a wrong length or checksum elsewhere, throws RecordError with
// file and offset, and so does a file that lets little be read again and again: overlapping chunks,
// more metadata than file, more unpacked than a bound by its size. A file without a complete
// summary, as a killed run leaves it, is scanned up to where it ends.
class McapReader final : public RecordingReader {
 public:
  explicit McapReader(std::filesystem::path file);

  // Chunks come in order of time, messages of a chunk in file order.
  using RecordingReader::ReadMessages;
  void ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const override;

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
    std::uint64_t size = 0;  // bytes of its record, as an index has them; 0 without one
    bool bare = false;
    bool empty = true;  // no message of it noted so far
  };

  std::vector<std::byte> Read(std::uint64_t offset, std::uint64_t size) const;
  Record ReadRecord(std::uint64_t offset) const;
  bool ReadSummary();
  bool Describes() const;
  void RequireApart() const;
  void CountUnpacked(ByteSpan chunk, std::uint64_t* sum) const;
  void Scan(std::uint64_t begin);
  void Note(const Record& record, bool in_summary);
  void NoteInChunk(std::uint64_t offset, const std::vector<std::byte>& records, Chunk* chunk);
  void NoteMessage(const McapMessage& message, Chunk* chunk);
  void LeaveOut(std::uint64_t offset, const std::string& why) const;
  [[noreturn]] void Fail(std::uint64_t offset, const std::string& what) const;

  UniqueFd fd_;
  std::uint64_t size_ = 0;
  std::vector<Chunk> chunks_;
  std::uint64_t scanned_ = 0;  // bytes that chunks without a summary unpack to
  std::uint64_t indexed_ = 0;  // bytes of metadata that indexes name
};

}  // namespace understudy::record
