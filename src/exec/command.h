// Finds the program of a command.
#pragma once

#include <string>

#include "base/errors.h"

namespace understudy::exec {

// Exit codes of `understudy exec` itself, as those of env(1).
inline constexpr int kExitOwnFailure = 125;     // the command was not tried
inline constexpr int kExitNotExecutable = 126;  // found, but it cannot be executed
inline constexpr int kExitNotFound = 127;

// A command that cannot be run. what() has its name and the reason.
class CommandError : public SetupError {
 public:
  CommandError(const std::string& what, int exit_code) : SetupError(what), exit_code_(exit_code) {}

  // One of the three codes above.
  int exit_code() const override { return exit_code_; }

 private:
  int exit_code_;
};

// Returns kExitNotFound for ENOENT, else kExitNotExecutable. `error` is the errno of exec(2).
int ExitCodeOfFailedExec(int error);

// Returns the path of a program: `name` itself if it has a slash, else the first executable file of
// that name in the folders of `search_path` (separated by colons; an empty one is the current
// folder). The result always has a slash. Throws CommandError: no file of that name, or it is a
// script whose interpreter is not there (127), or none that is executable (126).
std::string FindProgram(const std::string& name, const std::string& search_path);

}  // namespace understudy::exec
