#include "client/listening_socket.h"

#include <cerrno>
#include <chrono>
#include <string>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/signals.h"
#include "base/unique_fd.h"
#include "client/control_folder.h"

namespace understudy::client {
namespace {

// Locks a folder against other processes until the descriptor closes.
class FolderLock {
 public:
  // kWait: until a signal asks this process to end, at most kLongest; kBriefly: at most a second.
  enum class Patience { kWait, kTry, kBriefly };

  FolderLock(const std::filesystem::path& folder, Patience patience)
      : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    const auto end = std::chrono::steady_clock::now() +
                     (patience == Patience::kWait ? kLongest : std::chrono::seconds(1));
    while (folder_.valid() && !held_) {
      held_ = ::flock(folder_.get(), LOCK_EX | LOCK_NB) == 0;
      if (held_ || (errno != EWOULDBLOCK && errno != EINTR)) return;
      if (patience == Patience::kTry) return;
      if (patience == Patience::kWait && StopSignal() != 0) return;
      if (std::chrono::steady_clock::now() >= end) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  bool held() const { return held_; }
  // Whether the folder was removed before it could be locked.
  bool missed() const {
    struct stat found {};
    return !folder_.valid() || (::fstat(folder_.get(), &found) == 0 && found.st_nlink == 0);
  }

 private:
  // *Assumed*: others hold it for milliseconds, one that is stopped for as long as it is.
  static constexpr std::chrono::seconds kLongest{30};

  UniqueFd folder_;
  bool held_ = false;
};

sockaddr_un AddressOf(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.native().copy(address.sun_path, sizeof(address.sun_path) - 1);
  return address;
}

// The socket interface takes the addresses of all families as this type.
const sockaddr* Generic(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

[[noreturn]] void RefuseSocket(const std::filesystem::path& path, const std::string& why) {
  throw SocketError("control socket " + path.string() + ": " + why);
}

[[noreturn]] void RefuseBySystem(const std::filesystem::path& path) {
  RefuseSocket(path, std::generic_category().message(errno));
}

std::string Listener(const SocketProbe& probe) {
  return probe.pid == 0 ? "a process that is not visible from here"
                        : "process " + std::to_string(probe.pid);
}

// Locks a folder, which another process may remove meanwhile if it is one of RemoveControlFolder.
FolderLock Lock(const std::filesystem::path& folder) {
  while (true) {
    FolderLock lock(folder, FolderLock::Patience::kWait);
    if (!lock.missed() || !IsTransient(folder)) return lock;
    MakeControlFolder(folder);
  }
}

std::filesystem::path FolderOf(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path{"."};
}

}  // namespace

SocketProbe ProbeSocket(const std::filesystem::path& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) {
    return {.state = errno == ENOENT ? SocketState::kAbsent : SocketState::kUnknown};
  }
  if (!S_ISSOCK(found.st_mode)) return {.state = SocketState::kUnknown};

  const UniqueFd socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const sockaddr_un address = AddressOf(path);
  if (::connect(socket.get(), Generic(address), sizeof address) == 0) {
    ucred peer{};
    socklen_t size = sizeof peer;
    const bool known = ::getsockopt(socket.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
    return {.state = SocketState::kAlive, .pid = known ? peer.pid : 0};
  }
  switch (errno) {
    case EAGAIN:  // its queue is full: alive, but busy
      return {.state = SocketState::kAlive};
    case ECONNREFUSED:
      return {.state = SocketState::kStale};
    case ENOENT:
      return {.state = SocketState::kAbsent};
    default:
      return {.state = SocketState::kUnknown};
  }
}

void RemoveIfStale(const std::filesystem::path& path) {
  const FolderLock lock(FolderOf(path), FolderLock::Patience::kTry);
  if (lock.held() && ProbeSocket(path).state == SocketState::kStale) ::unlink(path.c_str());
}

void RemoveControlFolder(const std::filesystem::path& folder) {
  if (!IsTransient(folder)) return;
  const FolderLock lock(folder, FolderLock::Patience::kTry);
  if (lock.held()) ::rmdir(folder.c_str());
}

ListeningSocket::ListeningSocket(const std::filesystem::path& path) : path_(path) {
  CheckSocketPath(path_);
  const FolderLock lock = Lock(FolderOf(path_));
  if (!lock.held() && errno == EWOULDBLOCK) {
    RefuseSocket(path_, "another process holds the lock of its folder (`fuser -v " +
                            FolderOf(path_).string() + "` names it)");
  }
  if (!lock.held()) RefuseBySystem(path_);

  const SocketProbe before = ProbeSocket(path_);
  switch (before.state) {
    case SocketState::kAbsent:
      break;
    case SocketState::kStale:
      ::unlink(path_.c_str());
      break;
    case SocketState::kAlive:
      RefuseSocket(path_, "the name is in use by " + Listener(before) +
                              "; give this robot another --name, or end that one");
    case SocketState::kUnknown:
      RefuseSocket(path_, "something else is there, which is left alone");
  }

  UniqueFd socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const sockaddr_un address = AddressOf(path_);
  if (!socket.valid() || ::bind(socket.get(), Generic(address), sizeof address) != 0) {
    RefuseBySystem(path_);
  }
  // Clients cannot connect before listen(), so the mode is set in time.
  struct stat created {};
  if (::chmod(path_.c_str(), S_IRUSR | S_IWUSR) != 0 || ::lstat(path_.c_str(), &created) != 0 ||
      ::listen(socket.get(), SOMAXCONN) != 0) {
    const int cause = errno;
    ::unlink(path_.c_str());
    errno = cause;
    RefuseBySystem(path_);
  }
  device_ = created.st_dev;
  inode_ = created.st_ino;
  fd_ = socket.release();
}

ListeningSocket::~ListeningSocket() {
  const FolderLock lock(FolderOf(path_), FolderLock::Patience::kBriefly);
  struct stat found {};
  const bool ours =
      ::lstat(path_.c_str(), &found) == 0 && found.st_dev == device_ && found.st_ino == inode_;
  if (ours) ::unlink(path_.c_str());
  ::close(fd_);
}

}  // namespace understudy::client
