// Recordings that rosbag2 compressed by zstd: each message, or each file as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "base/temporary_folder.h"
#include "record/bytes.h"
#include "record/recording_reader.h"

namespace understudy::record {

// The first bytes of what zstd compressed (RFC 8878). No message in CDR begins so.
inline constexpr std::string_view kZstdMagic{"\x28\xB5\x2F\xFD", 4};

// Bytes to which a file of so many is unpacked at most; *assumed*, many times what robots say: a
// few bytes of a stranger could else fill memory or disk.
std::uint64_t MostUnpacked(std::uint64_t file);

// Returns the data of a message of `file`, unpacked into `room` if it is compressed. Throws
// RecordError with the file where that cannot be.
ByteSpan Unpacked(ByteSpan data, const std::filesystem::path& file, std::vector<std::byte>* room);

// Whether a file is compressed as a whole; not one that is a pipe or cannot be read.
bool IsPacked(const std::filesystem::path& path);

// A compressed file (.db3.zstd, .mcap.zstd), unpacked into a folder for as long as it is read.
// Throws RecordError with the file.
class PackedFile final : public RecordingReader {
 public:
  // `room` may have others in it.
  PackedFile(const std::filesystem::path& path, std::shared_ptr<const TemporaryFolder> room);

  using RecordingReader::ReadMessages;
  void ReadMessages(std::uint64_t from, std::uint64_t to, const Visit& visit) const override;

 private:
  // Calls `read`; its errors name this file.
  void Tell(const std::function<void()>& read) const;

  std::shared_ptr<const TemporaryFolder> room_;
  std::filesystem::path file_;  // in it
  std::unique_ptr<RecordingReader> inside_;
};

}  // namespace understudy::record
