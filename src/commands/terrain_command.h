// Runs `understudy terrain`: writes the ground of a run as files for other programs.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/set_options.h"

namespace understudy::commands {

// The command line, as typed.
struct TerrainArguments : SetArguments {
  std::string scene;
  std::string out;
};

// Adds the subcommand. `arguments` is filled by parsing and must outlive the app.
CLI::App* AddTerrainCommand(CLI::App* app, TerrainArguments* arguments);

// Writes the files and says where; returns the exit code. Throws SetupError.
int TerrainCommand(const TerrainArguments& arguments);

}  // namespace understudy::commands
