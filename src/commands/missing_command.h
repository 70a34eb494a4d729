// A command line that stops short of a command, or has a word that is none.
#ifndef UNDERSTUDY_COMMANDS_MISSING_COMMAND_H_
#define UNDERSTUDY_COMMANDS_MISSING_COMMAND_H_

#include <string>

#include <CLI/CLI.hpp>

namespace understudy::commands {

// What is wrong where `app` needs a subcommand and the command line names none, in a line with the
// nearest and all valid words: "no command 'stauts' of `understudy ctl`; did you mean 'status'?
// (valid: ...)". "" where the fault is another.
std::string MissingCommand(const CLI::App& app, int argc, const char* const* argv);

}  // namespace understudy::commands

#endif  // UNDERSTUDY_COMMANDS_MISSING_COMMAND_H_
