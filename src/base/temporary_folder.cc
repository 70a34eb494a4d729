#include "base/temporary_folder.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
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

int OpenFolder(const char* path) {
  return ::open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

void RemoveTree(const char* path) {
  constexpr int kDeepest = 8;
  const int folder = OpenFolder(path);
  if (folder >= 0) {
    Empty(folder, kDeepest);
    ::close(folder);
  }
  ::rmdir(path);
}

bool Lock(int folder) { return ::flock(folder, LOCK_EX | LOCK_NB) == 0; }

// Whether it belongs to this user, and was made so long ago that its maker has locked it.
bool IsOldAndOurs(int folder) {
  constexpr std::time_t kOld = 60;  // s
  struct stat status {};
  return ::fstat(folder, &status) == 0 && status.st_uid == ::geteuid() &&
         std::time(nullptr) - status.st_mtime > kOld;
}

// Removes what processes that were killed left in `parent`; `pattern` is mkdtemp's.
void Sweep(const std::filesystem::path& parent, const std::string& pattern) {
  constexpr std::size_t kRandom = 6;  // characters that mkdtemp chooses
  const std::string_view purpose = std::string_view(pattern).substr(0, pattern.size() - kRandom);
  std::error_code error;
  for (std::filesystem::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.size() != pattern.size() || !name.starts_with(purpose)) continue;
    const int folder = OpenFolder(entry->path().c_str());
    if (folder < 0) continue;
    if (IsOldAndOurs(folder) && Lock(folder)) RemoveTree(entry->path().c_str());
    ::close(folder);
  }
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
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  const std::string pattern = "understudy-" + purpose + "-XXXXXX";
  const std::string name = (parent / pattern).string();
  const bool fits = !error && name.size() < slot.path.size();
  if (fits) std::memcpy(slot.path.data(), name.c_str(), name.size() + 1);
  EndBySignalsCleanly();
  if (fits) Sweep(parent, pattern);
  if (!fits || ::mkdtemp(slot.path.data()) == nullptr) {
    const std::string why = fits ? std::generic_category().message(errno) : error.message();
    slot.owner = 0;
    throw SetupError(name + ": no temporary folder can be made: " + why + "; set TMPDIR");
  }
  path_ = slot.path.data();
  lock_ = OpenFolder(slot.path.data());
  Lock(lock_);
  slot.owner = ::getpid();
}

TemporaryFolder::~TemporaryFolder() {
  RemoveTree(slots[slot_].path.data());
  if (lock_ >= 0) ::close(lock_);
  slots[slot_].owner = 0;
}

void RemoveTemporaryFolders() {
  const pid_t self = ::getpid();  // not a parent's, between fork and exec
  for (Slot& slot : slots) {
    if (slot.owner.load() == self) RemoveTree(slot.path.data());
  }
}

}  // namespace understudy
