// Finds the program of a command, or says why it cannot be run.
#pragma once

#include <string>

#include "base/errors.h"

namespace understudy::exec {

// Exit codes of our own beside the command's, as env(1) has them.
inline constexpr int kExitOwnFailure = 125;     // the command was never tried
inline constexpr int kExitNotExecutable = 126;  // found, but the kernel does not run it
inline constexpr int kExitNotFound = 127;

// Thrown for a command that cannot be run. what() names it and the reason.
class CommandError : public SetupError {
 public:
  CommandError(const std::string& what, int exit_code) : SetupError(what), exit_code_(exit_code) {}

  // One of the three above.
  int exit_code() const override { return exit_code_; }

 private:
  int exit_code_;
};

// kExitNotFound for ENOENT, else kExitNotExecutable, where `error` is the errno of exec(2).
int ExitCodeOfFailedExec(int error);

// Returns the file that `name` stands for: itself when it holds a slash, else the first executable
// file of that name in the folders of `search_path` (separated by colons; an empty one is the
// current folder). The result always holds a slash. Throws CommandError: nothing of that name
// (127), or only what we may not execute (126).
std::string FindProgram(const std::string& name, const std::string& search_path);

}  // namespace understudy::exec
