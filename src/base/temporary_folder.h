// Makes temporary folders and removes them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace understudy {

// Makes a folder of its own in TMPDIR (/tmp) and removes it with all that is in it: when it is
// destroyed, and when SIGINT, SIGTERM or SIGHUP ends the process before that. Only kill -9 and a
// power cut leave it behind.
class TemporaryFolder {
 public:
  // `purpose` is part of its name, understudy-<purpose>-XXXXXX. Throws SetupError if it cannot be
  // made, or if this process has sixteen already.
  explicit TemporaryFolder(const std::string& purpose);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::size_t slot_ = 0;
};

// Removes all temporary folders of this process. For signal handlers: async-signal-safe.
void RemoveTemporaryFolders();

}  // namespace understudy
