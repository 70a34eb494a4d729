// Asks the kernel for real-time scheduling and locked memory.
#pragma once

#include <string>

namespace understudy::time {

struct RealtimeGrant {
  bool fifo = false;    // the calling thread runs under SCHED_FIFO
  bool locked = false;  // memory stays in RAM once touched
  std::string text;     // one line for the log: what was granted, and why the rest was not
};

// Requests SCHED_FIFO at a low real-time priority for the calling thread only (other threads keep
// the normal policy) and mlockall for present and future memory.
RealtimeGrant RequestRealtime();

}  // namespace understudy::time
