// Adds the subcommands of `understudy`, except `ctl` and the companion programs.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace understudy::commands {

// Runs the chosen subcommand and returns the exit code. Throws SetupError.
using Chosen = std::function<int()>;

// Each adds subcommands to the command line. Parsing sets `chosen`, which must outlive it, if one
// of them is used.
// `after_dashes`, which must outlive parsing: how many words follow --.
void AddRunCommands(CLI::App* app, Chosen* chosen, const std::size_t* after_dashes);  // run, exec
void AddTerrainCommand(CLI::App* app, Chosen* chosen);    // writes a run's ground to files
void AddRehearseCommand(CLI::App* app, Chosen* chosen);   // plays scenarios and judges them
void AddJudgeCommand(CLI::App* app, Chosen* chosen);      // judges a recording
void AddCameraCommand(CLI::App* app, Chosen* chosen);     // shows what a camera sees
void AddPlayCommand(CLI::App* app, Chosen* chosen);       // replays a recording onto the bus
void AddExportCommand(CLI::App* app, Chosen* chosen);     // writes a robot in others' forms
void AddNewCommand(CLI::App* app, Chosen* chosen);        // makes the files of a robot from URDF
void AddPolicyCommand(CLI::App* app, Chosen* chosen);     // checks a trained policy
void AddPlotCommand(CLI::App* app, Chosen* chosen);       // plots a recording
void AddCompareCommand(CLI::App* app, Chosen* chosen);    // compares two recordings
void AddIdentifyCommand(CLI::App* app, Chosen* chosen);   // fits a robot to recordings
void AddExciteCommand(CLI::App* app, Chosen* chosen);     // moves the joints for that
void AddDoctorCommand(CLI::App* app, Chosen* chosen);     // finds what is wrong with the network
void AddRecordingCommand(CLI::App* app, Chosen* chosen);  // lists the contents of a recording
// robots, check, version, services, requests. They need no running robot and print aligned text or
// one JSON document to standard output.
void AddInspectCommands(CLI::App* app, Chosen* chosen);
void AddCompletionsCommand(CLI::App* app, Chosen* chosen);

// If `app` needs a subcommand and the command line has no valid one, returns an error line with the
// nearest and all valid words: "no command 'stauts' of `understudy ctl`; did you mean 'status'?
// (valid: ...)". Returns "" otherwise.
std::string MissingCommand(const CLI::App& app, int argc, const char* const* argv);

// Returns an error line for the first word that looks like an option and is none, with the nearest
// one: "no option '--strat' of `understudy run`; did you mean '--start'?". Returns "" if there is
// none.
std::string UnknownOption(const CLI::App& app, int argc, const char* const* argv);

}  // namespace understudy::commands
