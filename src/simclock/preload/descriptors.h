// What the library remembers of descriptors.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include <poll.h>
#include <signal.h>

namespace understudy::simclock {

inline constexpr int kMostDescriptors = 4096;  // *assumed*; those above have no entry

struct Descriptor {
  std::atomic<std::int64_t> receive_timeout;  // simulated ns, 0: none
  std::atomic<std::int32_t> timer;            // 1 + its clockid_t, 0: no timer
};
extern std::array<Descriptor, kMostDescriptors> descriptors;
inline Descriptor* Of(int fd) {
  return fd >= 0 && fd < kMostDescriptors ? &descriptors[static_cast<std::size_t>(fd)] : nullptr;
}

int PollUntil(pollfd* fds, nfds_t n, std::int64_t deadline, const sigset_t* mask, const char* what);

// Forgets the timer of a descriptor that is being closed.
void DropTimer(int fd);

}  // namespace understudy::simclock
