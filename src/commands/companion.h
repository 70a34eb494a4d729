// Runs the companion programs behind some commands: they link libraries that the daemon does not.
#pragma once

#include <filesystem>
#include <string>

namespace CLI {
class App;
}

namespace understudy::commands {

struct Companion {
  const CLI::App* command;  // has the options, for --help, completions and a first check
  const char* program;      // in libexec/understudy, beside the bin of this program
  const char* missing;      // what to do where it is not there
};

// Returns the path of that program, whether it exists or not.
std::filesystem::path CompanionFile(const std::string& program);

// Replaces this process by the companion, which reads the same command line: its first argument is
// the command's name. Throws SetupError when it is not there or cannot be run.
[[noreturn]] void BecomeCompanion(const Companion& companion, char** argv);

}  // namespace understudy::commands
