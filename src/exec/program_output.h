// Looks for texts in what a program prints.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/unique_fd.h"

namespace understudy::exec {

// The standard output or error of a child process, passed on to ours. Output is a pseudo-terminal,
// so that a program in any language writes each line when it is complete, as to a terminal, and not
// when some KiB have come together. Errors, which programs do not hold back, are a pipe unless ours
// are on a terminal.
//
// A text is found once in a line, also in one that has no end yet.
class ProgramOutput {
 public:
  // `to`: STDOUT_FILENO or STDERR_FILENO. Throws CommandError if there is no pseudo-terminal or
  // pipe.
  explicit ProgramOutput(const std::vector<std::string>& texts, int to = 1);
  ProgramOutput(const ProgramOutput&) = delete;
  ProgramOutput& operator=(const ProgramOutput&) = delete;
  ~ProgramOutput() { Finish(); }

  // The descriptor for ChildProcess.
  int descriptor() const { return program_.get(); }

  // Starts to read, in a thread of its own. Call it when the child is forked.
  void Start();

  // Passes on what is left and ends the thread.
  void Finish();

  // After Finish: the last line that is not blank; of a long one its end.
  const std::string& last_line() const { return last_line_; }

  // Calls `told(text)` for each text found since, at most kMostAtOnce times; the others come next
  // time. Never waits. One thread.
  template <class Told>
  void TakeFound(Told&& told) {
    int left = kMostAtOnce;
    for (Text& text : texts_) {
      const std::uint64_t found = text.found.load(std::memory_order_acquire);
      for (; text.told < found && left > 0; ++text.told, --left) told(text.text);
    }
  }

 private:
  // Bounds the work of a tick and the events of a program that prints the same all the time;
  // *assumed*.
  static constexpr int kMostAtOnce = 16;

  struct Text {
    explicit Text(std::string looked_for) : text(std::move(looked_for)) {}

    std::string text;
    std::atomic<std::uint64_t> found{0};
    bool in_line = false;    // of the reading thread
    std::uint64_t told = 0;  // of the one that takes
  };

  void Read(const std::stop_token& stop);
  void Search(std::string_view bytes);

  void EndLine();

  std::deque<Text> texts_;
  int to_;
  UniqueFd ours_, program_;
  std::string line_, last_line_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace understudy::exec
