// Listens on the socket file of a running robot. One process claims a name; files of dead ones are
// removed.
#pragma once

#include <filesystem>

#include <sys/types.h>

namespace understudy::client {

enum class SocketState {
  kAbsent,   // no such file
  kStale,    // a socket whose process is gone
  kAlive,    // somebody listens
  kUnknown,  // not a socket, or not ours to open
};

struct SocketProbe {
  SocketState state = SocketState::kAbsent;
  pid_t pid = 0;  // of the listener; 0 when not alive, out of sight or too busy to tell
};

// Connects, asks the kernel who listens, and hangs up. Does not wait.
SocketProbe ProbeSocket(const std::filesystem::path& path);

// Removes the file at `path` if it is a stale socket, unless another process works in that folder
// just now. Does not wait.
void RemoveIfStale(const std::filesystem::path& path);

// A Unix stream socket that listens at `path`, mode 0600, from construction to destruction, when
// its file goes too. A stale file is replaced. Claims and removals in one folder exclude each other
// (flock on the folder), so that nobody takes a socket between its bind and its listen for stale.
class ListeningSocket {
 public:
  // Throws SocketError when somebody listens at `path`, when something else than a socket is
  // there, or when the system refuses.
  explicit ListeningSocket(const std::filesystem::path& path);
  ~ListeningSocket();
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;

  int fd() const { return fd_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  dev_t device_ = 0;
  ino_t inode_ = 0;
};

}  // namespace understudy::client
