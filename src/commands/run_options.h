// The command line that `run` and `exec` share.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/clock_options.h"
#include "commands/network_options.h"
#include "commands/set_options.h"

namespace understudy::commands {

// The command line of a run.
struct RunArguments : SetArguments {
  std::vector<std::string> robots;
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
  bool detach = false;
  bool open = false;
  bool as_robot = false;
  // exec only
  NetworkArguments network;
  ClockArguments clock;
  std::vector<std::string> command;
};

// Adds what both take. `arguments` must outlive parsing.
void AddRunOptions(CLI::App* app, RunArguments* arguments);

}  // namespace understudy::commands
