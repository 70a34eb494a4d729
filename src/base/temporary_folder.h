// Makes temporary folders and removes them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace understudy {

// Makes a folder of its own in TMPDIR (/tmp) and removes it with all that is in it: when it is
// destroyed, and when SIGINT, SIGTERM or SIGHUP ends the process before that. What kill -9 or a
// power cut leaves behind, the next of its purpose removes.
class TemporaryFolder {
 public:
  // `purpose` is part of its name, understudy-<purpose>-XXXXXX. Removes folders of this purpose
  // and user that no process holds, once they are a minute old. Throws SetupError if it cannot be
  // made, or if this process has sixteen already.
  explicit TemporaryFolder(const std::string& purpose);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::size_t slot_ = 0;
  int lock_ = -1;  // the folder itself: while it is open here, nobody sweeps it away
};

// Removes all temporary folders of this process. For signal handlers: async-signal-safe.
void RemoveTemporaryFolders();

}  // namespace understudy
