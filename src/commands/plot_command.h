// Runs `understudy plot`: draws curves of a recording.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "record/plot.h"

namespace understudy::commands {

// The command line, as typed.
struct PlotArguments {
  std::string file;
  std::string out;
  std::string size;
  record::PlotOptions options;
};

// Adds the subcommand. `arguments` is filled by parsing and must outlive the app.
CLI::App* AddPlotCommand(CLI::App* app, PlotArguments* arguments);

// Draws the picture and says where it is; returns the exit code. Throws SetupError.
int PlotCommand(const PlotArguments& arguments);

}  // namespace understudy::commands
