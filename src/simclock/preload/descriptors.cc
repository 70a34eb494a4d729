// Waiting for descriptors.
#include "simclock/preload/descriptors.h"

#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include "simclock/preload/core.h"

namespace understudy::simclock {

std::array<Descriptor, kMostDescriptors> descriptors{};

namespace {

constexpr timespec kAtOnce{};
constexpr int kIdleLook = 20;  // reads of the clock that a look without result counts as; *assumed*

// A mask for a wait, with our signal open.
class OpenMask {
 public:
  explicit OpenMask(const sigset_t* mask) {
    if (mask == nullptr) return;
    open_ = *mask;
    sigdelset(&open_, page->signal);
    mask_ = &open_;
  }
  const sigset_t* get() const { return mask_; }

 private:
  sigset_t open_;
  const sigset_t* mask_ = nullptr;
};

// `look(wait)` looks at descriptors: at once, or until something comes.
template <typename Look>
int LookUntil(std::int64_t deadline, const char* what, Look look) {
  const int ready = look(false);
  if (ready != 0) return ready;
  if (deadline <= Now()) {
    Read(kIdleLook);
    return 0;
  }
  return WaitIn(
      what, deadline, [&look] { return look(true); }, [&look] { return look(false); });
}

class Sets {
 public:
  Sets(int n, fd_set* r, fd_set* w, fd_set* e) : size_(static_cast<std::size_t>(n + 63) / 64 * 8) {
    sets_ = {r, w, e};
    for (std::size_t i = 0; i < sets_.size(); ++i) Copy(kept_[i].data(), sets_[i]);
  }
  void Restore() const {
    for (std::size_t i = 0; i < sets_.size(); ++i) Copy(sets_[i], kept_[i].data());
  }

 private:
  void Copy(void* to, const void* from) const {
    if (to != nullptr && from != nullptr) std::memcpy(to, from, size_);
  }
  static constexpr std::size_t kRoom = kMostDescriptors / 8;
  std::size_t size_;
  std::array<fd_set*, 3> sets_{};
  std::array<std::array<unsigned char, kRoom>, 3> kept_;
};

int SelectUntil(int n, fd_set* r, fd_set* w, fd_set* e, std::int64_t deadline,
                const sigset_t* wanted) {
  if (n < 0 || n > kMostDescriptors) {
    errno = EINVAL;
    return -1;
  }
  const OpenMask mask(wanted);
  const Sets sets(n, r, w, e);
  return LookUntil(deadline, "select", [&](bool wait) {
    sets.Restore();
    return REAL(pselect)(n, r, w, e, wait ? nullptr : &kAtOnce, mask.get());
  });
}

int EpollUntil(int fd, epoll_event* events, int n, std::int64_t deadline, const sigset_t* wanted) {
  const OpenMask mask(wanted);
  return LookUntil(deadline, "epoll", [&](bool wait) {
    return REAL(epoll_pwait)(fd, events, n, wait ? -1 : 0, mask.get());
  });
}

// Waits until a socket with SO_RCVTIMEO has something. Returns false with errno otherwise.
bool Arrives(int fd) {
  Descriptor* const one = Of(fd);
  const std::int64_t timeout = one == nullptr ? 0 : one->receive_timeout.load();
  if (timeout == 0 || (fcntl(fd, F_GETFL) & O_NONBLOCK) != 0) return true;
  pollfd ready{.fd = fd, .events = POLLIN, .revents = 0};
  const int count = PollUntil(&ready, 1, After(timeout), nullptr, "receive");
  if (count == 0) errno = EAGAIN;
  return count > 0;
}

template <typename Call>
auto Receive(const char* what, int fd, int flags, Call call) -> decltype(call()) {
  if ((flags & MSG_DONTWAIT) != 0 || !Waits()) return call();
  if (!Arrives(fd)) return -1;
  return WaitIn(what, call);
}

}  // namespace

int PollUntil(pollfd* fds, nfds_t n, std::int64_t deadline, const sigset_t* wanted,
              const char* what) {
  const OpenMask mask(wanted);
  return LookUntil(deadline, what, [&](bool wait) {
    return REAL(ppoll)(fds, n, wait ? nullptr : &kAtOnce, mask.get());
  });
}

}  // namespace understudy::simclock

using namespace understudy::simclock;  // NOLINT(google-build-using-namespace)

SIMCLOCK_EXPORT int ppoll(pollfd* fds, nfds_t n, const timespec* t, const sigset_t* mask) {
  return Waits() ? PollUntil(fds, n, After(t), mask, "poll") : REAL(ppoll)(fds, n, t, mask);
}
SIMCLOCK_EXPORT int poll(pollfd* fds, nfds_t n, int ms) {
  return Waits() ? PollUntil(fds, n, AfterMs(ms), nullptr, "poll") : REAL(poll)(fds, n, ms);
}
SIMCLOCK_EXPORT int __poll_chk(pollfd* fds, nfds_t n, int ms, std::size_t) {
  return poll(fds, n, ms);
}
SIMCLOCK_EXPORT int __ppoll_chk(pollfd* fds, nfds_t n, const timespec* t, const sigset_t* mask,
                                std::size_t) {
  return ppoll(fds, n, t, mask);
}

SIMCLOCK_EXPORT int select(int n, fd_set* r, fd_set* w, fd_set* e, timeval* t) {
  if (!Waits()) return REAL(select)(n, r, w, e, t);
  const std::int64_t deadline = t == nullptr ? kNever : After(Ns(*t));
  const int count = SelectUntil(n, r, w, e, deadline, nullptr);
  if (t != nullptr) *t = Micros(deadline - Now());  // as Linux does
  return count;
}
SIMCLOCK_EXPORT int pselect(int n, fd_set* r, fd_set* w, fd_set* e, const timespec* t,
                            const sigset_t* mask) {
  return Waits() ? SelectUntil(n, r, w, e, After(t), mask) : REAL(pselect)(n, r, w, e, t, mask);
}

SIMCLOCK_EXPORT int epoll_pwait(int fd, epoll_event* events, int n, int ms, const sigset_t* mask) {
  return Waits() ? EpollUntil(fd, events, n, AfterMs(ms), mask)
                 : REAL(epoll_pwait)(fd, events, n, ms, mask);
}
SIMCLOCK_EXPORT int epoll_wait(int fd, epoll_event* events, int n, int ms) {
  return Waits() ? EpollUntil(fd, events, n, AfterMs(ms), nullptr)
                 : REAL(epoll_wait)(fd, events, n, ms);
}
SIMCLOCK_EXPORT int epoll_pwait2(int fd, epoll_event* events, int n, const timespec* t,
                                 const sigset_t* mask) {
  return Waits() ? EpollUntil(fd, events, n, After(t), mask)
                 : REAL(epoll_pwait2)(fd, events, n, t, mask);
}

SIMCLOCK_EXPORT ssize_t recv(int fd, void* at, size_t n, int flags) {
  return Receive("receive", fd, flags, [&] { return REAL(recv)(fd, at, n, flags); });
}
SIMCLOCK_EXPORT ssize_t __recv_chk(int fd, void* at, size_t n, size_t, int flags) {
  return recv(fd, at, n, flags);
}
SIMCLOCK_EXPORT ssize_t recvfrom(int fd, void* at, size_t n, int flags, sockaddr* from,
                                 socklen_t* size) {
  return Receive("receive", fd, flags,
                 [&] { return REAL(recvfrom)(fd, at, n, flags, from, size); });
}
SIMCLOCK_EXPORT ssize_t __recvfrom_chk(int fd, void* at, size_t n, size_t, int flags,
                                       sockaddr* from, socklen_t* size) {
  return recvfrom(fd, at, n, flags, from, size);
}
SIMCLOCK_EXPORT ssize_t recvmsg(int fd, msghdr* message, int flags) {
  return Receive("receive", fd, flags, [&] { return REAL(recvmsg)(fd, message, flags); });
}
// The time-out of this one is looked at between two datagrams only.
SIMCLOCK_EXPORT int recvmmsg(int fd, mmsghdr* messages, unsigned n, int flags, timespec* t) {
  return Receive("receive", fd, flags,
                 [&] { return REAL(recvmmsg)(fd, messages, n, flags, Waits() ? nullptr : t); });
}
SIMCLOCK_EXPORT ssize_t read(int fd, void* at, size_t n) {
  const Descriptor* const one = Of(fd);
  if (one == nullptr || (one->timer == 0 && one->receive_timeout == 0)) {
    return REAL(read)(fd, at, n);
  }
  const ssize_t got = Receive("read", fd, 0, [&] { return REAL(read)(fd, at, n); });
  BeginThinking();
  return got;
}
SIMCLOCK_EXPORT ssize_t __read_chk(int fd, void* at, size_t n, size_t) { return read(fd, at, n); }
SIMCLOCK_EXPORT int accept(int fd, sockaddr* from, socklen_t* size) {
  return Receive("accept", fd, 0, [&] { return REAL(accept)(fd, from, size); });
}
SIMCLOCK_EXPORT int accept4(int fd, sockaddr* from, socklen_t* size, int flags) {
  return Receive("accept", fd, 0, [&] { return REAL(accept4)(fd, from, size, flags); });
}

SIMCLOCK_EXPORT int setsockopt(int fd, int level, int name, const void* value,
                               socklen_t size) noexcept {
  Descriptor* const one = Of(fd);
  const bool ours = level == SOL_SOCKET && name == SO_RCVTIMEO && size >= sizeof(timeval);
  if (!ours || one == nullptr || !OnClock(CALLER)) {
    return REAL(setsockopt)(fd, level, name, value, size);
  }
  timeval timeout{};
  std::memcpy(&timeout, value, sizeof(timeout));
  one->receive_timeout = Ns(timeout);
  return 0;
}
SIMCLOCK_EXPORT int close(int fd) {
  if (page != nullptr && !in_robot && fd == page_file) return 0;
  if (Descriptor* const one = Of(fd); page != nullptr && one != nullptr) {
    one->receive_timeout = 0;
    if (one->timer != 0) DropTimer(fd);
  }
  return REAL(close)(fd);
}

SIMCLOCK_EXPORT int close_range(unsigned from, unsigned to, int flags) noexcept {
  const auto kept = static_cast<unsigned>(page_file);
  if (page == nullptr || in_robot || kept < from || kept > to) {
    return REAL(close_range)(from, to, flags);
  }
  if (kept > from && REAL(close_range)(from, kept - 1, flags) != 0) return -1;
  return kept < to ? REAL(close_range)(kept + 1, to, flags) : 0;
}
SIMCLOCK_EXPORT void closefrom(int from) noexcept {
  close_range(static_cast<unsigned>(from), ~0U, 0);
}
