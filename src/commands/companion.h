// Runs the companion programs: they link libraries that the daemon does not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exec/child_process.h"

namespace CLI {
class App;
}

namespace understudy::commands {

// A command that is a program of its own.
struct Companion {
  const CLI::App* command;  // has the options, for --help, completions and a first check
  const char* program;      // in libexec/understudy, beside the bin of this program
  const char* missing;      // what to do where it is not there
};

// Replaces this process by the companion, which reads the same command line: its first argument is
// the command's name. Throws SetupError when it is not there or cannot be run.
[[noreturn]] void BecomeCompanion(const Companion& companion, char** argv);

// A companion beside a run: the window of `run --view`, the gamepad of `run --gamepad`. The robot
// goes on whatever happens to it.
class CompanionProcess {
 public:
  // Call it before any thread exists; the companion starts at Release(). `what`: how the log calls
  // it, "the window". `words`: of its command line after the program; `missing`: what to do where
  // that is not there.
  CompanionProcess(std::string what, const char* program, const char* missing,
                   const std::vector<std::string>& words);

  // Call it once the robot answers. Warns when the companion cannot be started.
  void Release();
  // Logs once that the companion has ended.
  void Watch();

 private:
  std::string what_;
  std::optional<exec::ChildProcess> child_;  // nothing where there is nothing to watch (any more)
  std::string why_not_;                      // it could not be started
};

}  // namespace understudy::commands
