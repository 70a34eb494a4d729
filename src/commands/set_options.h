// Declares the options that change the configuration.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace understudy::commands {

// The values of these options, as typed.
struct SetArguments {
  std::vector<std::string> config_files;
  std::vector<std::string> sets;  // "key=value"; short options are put in front of --set
};

// Both: `arguments` is filled by parsing and must outlive the app.

// Adds an option that abbreviates a --set: its value goes to `key`; an explicit --set of that key
// wins.
CLI::Option* AddShortOption(CLI::App* app, SetArguments* arguments, const std::string& option,
                            const std::string& key, const std::string& type,
                            const std::string& help);

// Adds --config FILE and --set KEY=VALUE, with an example of the latter.
void AddSetOptions(CLI::App* app, SetArguments* arguments, const std::string& config_help,
                   const std::string& example);

}  // namespace understudy::commands
