// Wakes a thread that waits for a file descriptor.
#pragma once

#include <cstdint>

#include <sys/eventfd.h>
#include <unistd.h>

#include "base/unique_fd.h"

namespace understudy {

// Any thread may ring it. No function blocks; a waiting thread polls fd().
class Bell {
 public:
  Bell() : fd_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

  void Ring() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = ::write(fd_.get(), &one, sizeof one);
  }
  // Returns whether it was rung since the last call.
  bool Answer() const {
    std::uint64_t rings = 0;
    return ::read(fd_.get(), &rings, sizeof rings) == sizeof rings;
  }
  int fd() const { return fd_.get(); }  // readable while a ring is unanswered

 private:
  UniqueFd fd_;
};

}  // namespace understudy
