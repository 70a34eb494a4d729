#include "time/realtime.h"

#include <cerrno>
#include <cstring>

#include <sched.h>
#include <sys/mman.h>

namespace understudy::time {
namespace {

constexpr int kPriority = 10;  // above normal threads, below the kernel's interrupt threads (50)

}  // namespace

RealtimeGrant RequestRealtime() {
  RealtimeGrant grant;
  const sched_param parameter{.sched_priority = kPriority};
  // Reset on fork: threads and programs that we start do not inherit it.
  grant.fifo = sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameter) == 0;
  grant.text = grant.fifo ? "SCHED_FIFO granted"
                          : std::string("SCHED_FIFO not granted (") + std::strerror(errno) +
                                "; see docs/reference/realtime.md)";
  grant.locked = mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0;
  grant.text += grant.locked ? ", memory locked"
                             : std::string(", memory not locked (") + std::strerror(errno) + ")";
  return grant;
}

}  // namespace understudy::time
