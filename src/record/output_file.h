// A file that only grows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/unique_fd.h"
#include "record/bytes.h"

namespace understudy::record {

// Locked against a second writer for as long as it is open.
class OutputFile {
 public:
  // Throws RecordError: when the file is there already and `overwrite` is off, when another run
  // writes it, and with the system's words when it cannot be made.
  OutputFile(std::filesystem::path path, bool overwrite);

  // All of it at once, or RecordError with the system's words (a full disk) and the file cut back
  // to where it was.
  void Write(ByteSpan bytes);

  std::uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  UniqueFd fd_;
  std::uint64_t size_ = 0;
};

}  // namespace understudy::record
