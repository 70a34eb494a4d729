// A file in memory with a fuzzer's bytes, for what reads files by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

#include "base/unique_fd.h"

namespace understudy::test {

class MemoryFile {
 public:
  MemoryFile() : fd_(::memfd_create("fuzz", MFD_CLOEXEC)) {}

  // Replaces the content. Returns the file's path, valid as long as this.
  std::filesystem::path Write(std::span<const std::uint8_t> bytes) {
    if (::ftruncate(fd_.get(), 0) != 0 ||
        ::pwrite(fd_.get(), bytes.data(), bytes.size(), 0) < static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("no room for a file in memory");
    }
    return "/proc/self/fd/" + std::to_string(fd_.get());
  }

 private:
  UniqueFd fd_;
};

}  // namespace understudy::test
