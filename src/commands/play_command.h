// Runs `understudy play`: replays a recording onto the bus.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "config/config.h"
#include "record/player.h"

namespace understudy::commands {

// The command line, as typed.
struct PlayArguments {
  std::string file;
  bool commands = false;
  std::string speed = "1";
  record::PlayOptions options;
  config::NetworkConfig network;
  bool json = false;
};

// Adds the subcommand. `arguments` is filled by parsing and must outlive the app.
CLI::App* AddPlayCommand(CLI::App* app, PlayArguments* arguments);

// Plays to the end or until Ctrl-C; returns the exit code. Throws SetupError.
int PlayCommand(const PlayArguments& arguments);

}  // namespace understudy::commands
