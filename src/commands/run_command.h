// Runs `understudy run` and `understudy exec`, and declares the options they share.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/set_options.h"

namespace understudy::commands {

// The command line of a run, as typed.
struct RunArguments : SetArguments {
  std::string robot;
  std::string name;
  std::string script;
  bool view = false;
  std::string record;
  bool overwrite = false;
  bool print_config = false;
  bool help_config = false;
  bool json = false;
  std::string log_level;
  // run only
  bool gamepad = false;
  // exec only
  std::string network = "private";
  std::vector<std::string> command;
};

// Adds the subcommand. `arguments` is filled by parsing and must outlive the app.
CLI::App* AddRunCommand(CLI::App* app, RunArguments* arguments);
CLI::App* AddExecCommand(CLI::App* app, RunArguments* arguments);

// Throw SetupError. ExecCommand returns the command's own exit code.
int RunCommand(const RunArguments& arguments);
int ExecCommand(const RunArguments& arguments);

}  // namespace understudy::commands
