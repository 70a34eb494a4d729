#include "base/temporary_folder.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/signals.h"

namespace understudy {
namespace {

// A handler may run at any moment and cannot allocate: it finds the paths here.
struct Slot {
  std::atomic<pid_t> owner{0};  // 0: free, -1: being filled or emptied
  std::array<char, PATH_MAX> path{};
};
std::array<Slot, 16> slots;

struct LinuxEntry {  // linux_dirent64 of getdents64(2), which opendir(3) hides
  std::uint64_t inode;
  std::int64_t offset;
  unsigned short length;
  unsigned char type;
  char name[1];
};

bool IsDots(const char* name) {
  return std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0;
}

// Empties the folder; `depth` bounds the recursion.
void Empty(int folder, int depth) {
  alignas(LinuxEntry) std::array<char, 2048> entries;
  // Entries vanish while they are listed: from the beginning, until nothing more can be removed.
  for (bool removed = true; removed;) {
    removed = false;
    ::lseek(folder, 0, SEEK_SET);
    long size = 0;
    while ((size = ::syscall(SYS_getdents64, folder, entries.data(), entries.size())) > 0) {
      for (long at = 0; at < size;) {
        const auto* entry =
            reinterpret_cast<const LinuxEntry*>(&entries[static_cast<std::size_t>(at)]);
        at += entry->length;
        if (IsDots(entry->name)) continue;
        if (::unlinkat(folder, entry->name, 0) == 0) {
          removed = true;
          continue;
        }
        const int below =
            ::openat(folder, entry->name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (below < 0) continue;
        if (depth > 0) Empty(below, depth - 1);
        ::close(below);
        if (::unlinkat(folder, entry->name, AT_REMOVEDIR) == 0) removed = true;
      }
    }
  }
}

void RemoveTree(const char* path) {
  constexpr int kDeepest = 8;
  const int folder = ::open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder >= 0) {
    Empty(folder, kDeepest);
    ::close(folder);
  }
  ::rmdir(path);
}

std::size_t Claim() {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    pid_t free = 0;
    if (slots[i].owner.compare_exchange_strong(free, -1)) return i;
  }
  throw SetupError("no more than " + std::to_string(slots.size()) + " temporary folders");
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& purpose) : slot_(Claim()) {
  Slot& slot = slots[slot_];
  std::error_code error;
  const std::string name =
      (std::filesystem::temp_directory_path(error) / ("understudy-" + purpose + "-XXXXXX"))
          .string();
  const bool fits = !error && name.size() < slot.path.size();
  if (fits) std::memcpy(slot.path.data(), name.c_str(), name.size() + 1);
  EndBySignalsCleanly();
  if (!fits || ::mkdtemp(slot.path.data()) == nullptr) {
    const std::string why = fits ? std::generic_category().message(errno) : error.message();
    slot.owner = 0;
    throw SetupError(name + ": no temporary folder can be made: " + why + "; set TMPDIR");
  }
  path_ = slot.path.data();
  slot.owner = ::getpid();
}

TemporaryFolder::~TemporaryFolder() {
  RemoveTree(slots[slot_].path.data());
  slots[slot_].owner = 0;
}

void RemoveTemporaryFolders() {
  const pid_t self = ::getpid();  // not a parent's, between fork and exec
  for (Slot& slot : slots) {
    if (slot.owner.load() == self) RemoveTree(slot.path.data());
  }
}

}  // namespace understudy
