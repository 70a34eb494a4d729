// Refuses a command line with no command, or with an unknown one.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace understudy::commands {

// Returns an error line when `app` needs a subcommand and the command line names none, with the
// nearest and all valid words: "no command 'stauts' of `understudy ctl`; did you mean 'status'?
// (valid: ...)". "" for any other fault.
std::string MissingCommand(const CLI::App& app, int argc, const char* const* argv);

}  // namespace understudy::commands
