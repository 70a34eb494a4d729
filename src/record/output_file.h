// Writes a file by appending.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/unique_fd.h"
#include "record/bytes.h"

namespace understudy::record {

// Whether a name may be that of a link, whose file is then written.
enum class Links : std::uint8_t { kFollowed, kRefused };

// An append-only file, locked against other writers while it is open.
class OutputFile {
 public:
  // Creates the file. Throws RecordError if it exists and `overwrite` is false, if another run is
  // writing it, if it is a link and those are refused, or if the system refuses (with its message).
  OutputFile(std::filesystem::path path, bool overwrite, Links links = Links::kFollowed);

  // Appends all bytes. If that fails (a full disk), truncates the file to its previous size and
  // throws RecordError with the system's message.
  void Write(ByteSpan bytes);

  std::uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  UniqueFd fd_;
  std::uint64_t size_ = 0;
};

}  // namespace understudy::record
