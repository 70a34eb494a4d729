// Runs the companion programs, which link libraries that the daemon does not.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/unique_fd.h"
#include "exec/child_process.h"

namespace CLI {
class App;
}

namespace understudy::commands {

// A command that is a separate program.
struct Companion {
  const CLI::App* command;  // its options, for --help, completions and a first check
  const char* program;      // its name in libexec/understudy, beside bin
  const char* missing;      // how to install it
};

// Replaces this process by the companion, with the same command line: the command's name is its
// first argument. Throws SetupError if it is missing or cannot be run.
[[noreturn]] void BecomeCompanion(const Companion& companion, char** argv);

// A companion beside a run: the window of `run --view`, the gamepad of `run --gamepad`. The robot
// continues if it fails or ends. What it and its libraries say on standard error become lines of
// our log.
class CompanionProcess {
 public:
  // Call it before any thread exists; the companion starts at Release(). `what` is its name in the
  // log, as in "the window"; `program` and `missing` are as in Companion; `words` are its
  // arguments.
  CompanionProcess(std::string what, const char* program, const char* missing,
                   const std::vector<std::string>& words);

  // Starts the companion. Call it when the robot answers. Logs a warning if it cannot be started.
  void Release();
  // Logs what the companion says, and its end, once.
  void Watch();

 private:
  void LogLines();

  std::string what_;
  UniqueFd said_;       // the reading end of its standard error
  std::string unsaid_;  // the beginning of a line
  std::optional<exec::ChildProcess>
      child_;            // nullopt before the start failed or after the end was logged
  std::string why_not_;  // the reason if it could not be started
};

}  // namespace understudy::commands
