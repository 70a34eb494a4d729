// Waiting for what other threads bring about, with a bound.
#pragma once

#include <chrono>
#include <thread>

namespace understudy::test {

// Asks `holds` again and again until it says yes or `bound` has passed; returns its last answer.
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
