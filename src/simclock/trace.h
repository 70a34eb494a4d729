// Tells who waits for what until when.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "simclock/page.h"
#include "simclock/sleepers.h"

namespace understudy::simclock {

// Returns a line with the simulated time and one for each thread on the clock, in the order of
// their slots: "  thread 1234 of python3 (1230), python3: waits in condition until 2.5 s".
// `stands`: time has stood still since it was last told.
std::string WaitsText(const Page& page, const Sleepers& sleepers, bool stands);

// A thread on real time that tells so every `period`, while anything has changed since. Make it
// after the program and before the loop takes its core.
class WaitTrace {
 public:
  using Say = std::function<void(const std::string& lines)>;

  // `page` must outlive it.
  WaitTrace(Page* page, Say say, std::chrono::milliseconds period = std::chrono::seconds(1));

 private:
  void Tell(const std::stop_token& stop, std::chrono::milliseconds period);

  Page& page_;
  Sleepers sleepers_;
  Say say_;
  std::jthread thread_;  // uses the above
};

}  // namespace understudy::simclock
