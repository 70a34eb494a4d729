// The subcommands of `understudy`, but for `ctl` and those that are companions.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace understudy::commands {

// What the command line asks for: does it and returns the exit code. Throws SetupError.
using Chosen = std::function<int()>;

// Each adds subcommands to the command line; parsing sets `chosen`, which must outlive it, to the
// one that was asked for.
void AddRunCommands(CLI::App* app, Chosen* chosen);       // run, exec
void AddTerrainCommand(CLI::App* app, Chosen* chosen);    // writes a run's ground to files
void AddPlayCommand(CLI::App* app, Chosen* chosen);       // replays a recording onto the bus
void AddPlotCommand(CLI::App* app, Chosen* chosen);       // draws curves of a recording
void AddRecordingCommand(CLI::App* app, Chosen* chosen);  // lists what a recording holds
// robots, check, version, services, requests: what needs no running robot. Each prints to standard
// output, as aligned text or as one JSON document.
void AddInspectCommands(CLI::App* app, Chosen* chosen);
void AddCompletionsCommand(CLI::App* app, Chosen* chosen);

// Returns an error line when `app` needs a subcommand and the command line names none, with the
// nearest and all valid words: "no command 'stauts' of `understudy ctl`; did you mean 'status'?
// (valid: ...)". "" for any other fault.
std::string MissingCommand(const CLI::App& app, int argc, const char* const* argv);

}  // namespace understudy::commands
