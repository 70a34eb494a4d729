// Runs a companion program beside a run: the window of `run --view`, the gamepad of `run
// --gamepad`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exec/child_process.h"

namespace understudy::commands {

// The robot goes on whatever happens to the companion.
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
