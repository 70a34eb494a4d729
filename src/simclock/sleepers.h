// Looks whether the threads of a page sleep in the kernel.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/unique_fd.h"
#include "simclock/page.h"

namespace understudy::simclock {

enum class Sleep { kAwake, kAsleep, kGone };

// Reads /proc of the threads in the slots of a page. For one thread.
class Sleepers {
 public:
  explicit Sleepers(Page* page) : page_(*page), files_(kMostThreads) {}

  // Of the thread in a slot. One that does not say that it waits is asleep only in a system call
  // that waits for somebody, not for the disk or for memory.
  Sleep Look(std::uint32_t slot);

  // Nanoseconds of CPU that the thread has had; 0 if it is gone.
  std::int64_t CpuOf(std::uint32_t slot) const;

  // The call in which the thread sleeps without saying that it waits, as "nanosleep" or "system
  // call 61"; "" if it is in none, or the kernel does not tell.
  std::string CallOf(std::uint32_t slot) const;

  // "thread 1234, dq.builtin, of python3 (1230)": for a line of the log.
  std::string Describe(std::uint32_t slot) const;

 private:
  struct File {
    UniqueFd wchan{};
    std::int32_t tid = 0;
  };

  Page& page_;
  std::vector<File> files_;
};

// Whether no thread of a process is left.
bool HasEnded(int pid);

// Whether the library is in a process; true where that cannot be read.
bool HasLibrary(int pid);

// The name of a process; "" if it is gone.
std::string NameOfProcess(int pid);

}  // namespace understudy::simclock
