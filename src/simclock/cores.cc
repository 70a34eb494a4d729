#include "simclock/cores.h"

#include <string>
#include <vector>

#include <fcntl.h>
#include <sched.h>
#include <sys/file.h>

namespace understudy::simclock {

void Pin(int core) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(core), &set);
  ::sched_setaffinity(0, sizeof(set), &set);
}

void KeepOff(int core) {
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof(set), &set) != 0) return;
  CPU_CLR(static_cast<std::size_t>(core), &set);
  ::sched_setaffinity(0, sizeof(set), &set);
}

bool TakeFifo() {
  const sched_param below{.sched_priority = 1};
  return ::sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &below) == 0;
}

std::optional<std::pair<int, UniqueFd>> CoreOfOurOwn() {
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof(set), &set) != 0) return std::nullopt;
  std::vector<int> cores;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(static_cast<std::size_t>(i), &set)) cores.push_back(i);
  }
  for (; cores.size() > 1; cores.pop_back()) {
    const std::string file = "/sys/devices/system/cpu/cpu" + std::to_string(cores.back());
    UniqueFd lock(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    if (lock.valid() && ::flock(lock.get(), LOCK_EX | LOCK_NB) == 0) {
      return std::pair(cores.back(), std::move(lock));
    }
  }
  return std::nullopt;
}

}  // namespace understudy::simclock
