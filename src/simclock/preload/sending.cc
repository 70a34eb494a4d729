// Sending.
#include <array>
#include <cstddef>
#include <cstring>

#include <sys/socket.h>

#include "simclock/preload/core.h"

using namespace understudy::simclock;  // NOLINT(google-build-using-namespace)

namespace {

// A datagram that waits for the end of a step; its bytes follow it.
struct Held {
  int fd, flags;
  socklen_t to_size;
  sockaddr_storage to;
  std::size_t size;
};

constexpr std::size_t kRoom = std::size_t{1} << 22;  // bytes of a step; *assumed*
alignas(Held) std::array<unsigned char, kRoom> room;
std::size_t used = 0;
thread_local __attribute__((tls_model("initial-exec"))) bool holds = false;

void SendHeld() {
  for (std::size_t at = 0; at < used;) {
    Held held;
    std::memcpy(&held, &room[at], sizeof(held));
    iovec bytes{.iov_base = &room[at + sizeof(held)], .iov_len = held.size};
    msghdr message{};
    message.msg_name = held.to_size > 0 ? &held.to : nullptr;
    message.msg_namelen = held.to_size;
    message.msg_iov = &bytes;
    message.msg_iovlen = 1;
    REAL(sendmsg)(held.fd, &message, held.flags);
    at += sizeof(held) + held.size;
  }
  used = 0;
}

// Returns its size, or 0 if there is no room for it.
std::size_t Hold(int fd, const msghdr& message, int flags) {
  Held held{.fd = fd, .flags = flags, .to_size = message.msg_namelen, .to = {}, .size = 0};
  for (std::size_t i = 0; i < message.msg_iovlen; ++i) held.size += message.msg_iov[i].iov_len;
  if (message.msg_controllen > 0 || held.to_size > sizeof(held.to) ||
      held.size + sizeof(held) > room.size() - used) {
    return 0;
  }
  if (held.to_size > 0) std::memcpy(&held.to, message.msg_name, held.to_size);
  std::memcpy(&room[used], &held, sizeof(held));
  used += sizeof(held);
  for (std::size_t i = 0; i < message.msg_iovlen; ++i) {
    std::memcpy(&room[used], message.msg_iov[i].iov_base, message.msg_iov[i].iov_len);
    used += message.msg_iov[i].iov_len;
  }
  return held.size;
}

}  // namespace

// For the thread of the robot's steps: what it sends is held, and sent by `hold` false.
SIMCLOCK_EXPORT void simclock_hold(bool hold) {
  holds = hold;
  if (!hold) SendHeld();
}

SIMCLOCK_EXPORT ssize_t send(int fd, const void* at, size_t n, int flags) {
  Think();
  return REAL(send)(fd, at, n, flags);
}
SIMCLOCK_EXPORT ssize_t sendto(int fd, const void* at, size_t n, int flags, const sockaddr* to,
                               socklen_t size) {
  Think();
  return REAL(sendto)(fd, at, n, flags, to, size);
}
SIMCLOCK_EXPORT ssize_t sendmsg(int fd, const msghdr* message, int flags) {
  if (holds) {
    if (const std::size_t size = Hold(fd, *message, flags)) return static_cast<ssize_t>(size);
    SendHeld();  // in their order
  }
  Think();
  return REAL(sendmsg)(fd, message, flags);
}
