// Walks the words of a command line through the subcommands and options of the program.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace understudy::commands {

// The program and the subcommands so far, each of which may define an option.
using CommandPath = std::vector<const CLI::App*>;

// Returns the option of that name ("--start") of the last command on the path that has one; null if
// none has.
const CLI::Option* FindOption(const CommandPath& path, const std::string& name);

// Returns whether the word is an option that takes the next word as its value.
bool TakesNext(const CommandPath& path, const std::string& word);

// Returns the subcommand of that name; null if there is none.
const CLI::App* FindCommand(const CLI::App& app, const std::string& name);

// Returns the subcommands that are for people; the others have no group.
std::vector<std::string> CommandNames(const CLI::App& app);

// Returns the names of all options on the path, each with its "--".
std::vector<std::string> OptionNames(const CommandPath& path);

}  // namespace understudy::commands
