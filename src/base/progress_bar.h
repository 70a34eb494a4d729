// Shows the progress of long work on a terminal.
#pragma once

#include <chrono>
#include <string>

namespace understudy {

// What is counted.
enum class ProgressOf {
  kSeconds,  // s
  kSteps,    // of which there may be fewer than `whole`
};

// Returns "go2.mp4 [##########----------] 50 %  5.0 of 10.0 s, 3 s to go"; of steps "... step 5 of
// at most 10, at most 3 s to go". `elapsed` is wall time [s] since the start.
std::string ProgressText(const std::string& what, double done, double whole, double elapsed,
                         ProgressOf of = ProgressOf::kSeconds);

// Redraws one line of standard error; does nothing if that is not a terminal.
class ProgressBar {
 public:
  explicit ProgressBar(std::string what, ProgressOf of = ProgressOf::kSeconds);
  ~ProgressBar();  // leaves the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Draws at most ten times a second.
  void Show(double done, double whole, const std::string& note = "");

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  ProgressOf of_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
};

}  // namespace understudy
