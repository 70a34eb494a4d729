#include "base/standard_error.h"

#include <algorithm>
#include <cerrno>
#include <mutex>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/unique_fd.h"

namespace understudy {
namespace {

constexpr int kPatience = 200;  // ms, *assumed*
// A pipe that poll() calls writable takes this much without blocking (pipe(7): PIPE_BUF).
constexpr std::size_t kNeverBlocks = 4096;

class Stream {
 public:
  Stream() {
    struct stat about {};
    if (::fstat(STDERR_FILENO, &about) != 0) return;
    socket_ = S_ISSOCK(about.st_mode);
    if (!S_ISFIFO(about.st_mode) && !S_ISCHR(about.st_mode)) return;
    // Opened anew, since flags of descriptor 2 would also apply to processes that share it.
    own_ = UniqueFd(::open("/proc/self/fd/2", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    may_block_ = !own_.valid();  // another user's, as after `su`
  }

  bool Write(std::string_view text) {
    const std::lock_guard lock(mutex_);
    if (cut_ && !Send("\n")) return false;
    cut_ = false;
    return Send(text);
  }

 private:
  bool Send(std::string_view text) {
    const std::size_t all = text.size();
    while (!text.empty()) {
      const ssize_t sent = SendSome(text);
      if (sent > 0) {
        text.remove_prefix(static_cast<std::size_t>(sent));
        stuck_ = false;
      } else if (sent < 0 && errno == EINTR) {
        continue;
      } else if (sent == 0 || errno != EAGAIN || !Wait()) {
        cut_ = text.size() < all;
        return false;
      }
    }
    return true;
  }

  ssize_t SendSome(std::string_view text) const {
    if (socket_)
      return ::send(STDERR_FILENO, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (!may_block_) {
      return ::write(own_.valid() ? own_.get() : STDERR_FILENO, text.data(), text.size());
    }
    if (HasRoom(0)) return ::write(STDERR_FILENO, text.data(), std::min(text.size(), kNeverBlocks));
    errno = EAGAIN;
    return -1;
  }

  static bool HasRoom(int patience) {
    pollfd room{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    return ::poll(&room, 1, patience) == 1;
  }

  bool Wait() {
    stuck_ = stuck_ || !HasRoom(kPatience);
    return !stuck_;
  }

  std::mutex mutex_;
  bool socket_ = false;
  bool may_block_ = false;
  UniqueFd own_;
  bool stuck_ = false;  // the last wait timed out
  bool cut_ = false;    // the last text was cut off
};

}  // namespace

bool WriteToStandardError(std::string_view text) {
  static Stream stream;
  return stream.Write(text);
}

}  // namespace understudy
