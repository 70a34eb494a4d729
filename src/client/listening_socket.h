// Listens on the socket file of a running robot and removes the files of dead ones.
#pragma once

#include <filesystem>

#include <sys/types.h>

namespace understudy::client {

enum class SocketState {
  kAbsent,   // no such file
  kStale,    // a socket whose process has ended
  kAlive,    // a process listens
  kUnknown,  // not a socket, or no permission
};

struct SocketProbe {
  SocketState state = SocketState::kAbsent;
  pid_t pid = 0;  // of the listener; 0 if not alive, or unknown as in RunningRobot
};

// Connects, asks the kernel for the listener, and disconnects. Does not wait.
SocketProbe ProbeSocket(const std::filesystem::path& path);

// Removes the file at `path` if it is a stale socket, unless another process holds the folder's
// lock. Does not wait.
void RemoveIfStale(const std::filesystem::path& path);

// Removes a control folder that IsTransient if nothing is in it, unless another process holds its
// lock. Does not wait.
void RemoveControlFolder(const std::filesystem::path& folder);

// A Unix stream socket that listens at `path`, mode 0600; the destructor closes it and removes the
// file. A stale file is replaced, a transient folder that another process has just removed made
// again. Creation and removal hold a flock on the folder, so a socket
// between its bind and its listen is never taken for stale.
class ListeningSocket {
 public:
  // Throws SocketError if a process listens at `path`, if the file is not a socket, or if the
  // system refuses.
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
