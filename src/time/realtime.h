// Asks the kernel for punctuality.
#pragma once

#include <string>

namespace understudy::time {

struct RealtimeGrant {
  bool fifo = false;    // the calling thread runs under SCHED_FIFO
  bool locked = false;  // memory stays in RAM once touched
  std::string text;     // one line for the log: what was granted, what not and why
};

// SCHED_FIFO at a low real-time priority for the calling thread only, so that threads started
// before and after keep the ordinary policy, and mlockall for what is and will be touched.
RealtimeGrant RequestRealtime();

}  // namespace understudy::time
