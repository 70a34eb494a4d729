// Waits, with a bound, for effects of other threads.
#pragma once

#include <chrono>
#include <thread>

namespace understudy::test {

// Calls `holds` repeatedly until it returns true or `bound` has passed; returns its last result.
template <typename Predicate>
bool Eventually(Predicate&& holds, std::chrono::milliseconds bound = std::chrono::seconds(20)) {
  const auto end = std::chrono::steady_clock::now() + bound;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return holds();
    std::this_thread::yield();
  }
  return true;
}

}  // namespace understudy::test
