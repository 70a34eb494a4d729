// Runs programs on a simulated clock, without a robot.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace understudy::test {

struct ClockedRun {
  int code = -1;          // of the program, 128 + n if signal n ended it
  std::string printed{};  // on standard output
  double simulated = 0;   // s
  double wall = 0;        // s
  std::string unrepeatable{};
  std::optional<std::chrono::nanoseconds> computed{};  // as MedianComputed has it
};

struct ClockedOptions {
  std::chrono::nanoseconds think{};
  bool realtime = false;
  std::chrono::nanoseconds most_computing = std::chrono::seconds(10);
  // Called before each step of 1 ms; may be empty.
  std::function<void(int step)> at_step{};
};

// Runs a program until it ends, in steps of 1 ms of simulated time. Gives up after 30 s.
ClockedRun RunOnClock(const std::vector<std::string>& command, const ClockedOptions& options = {});

}  // namespace understudy::test
