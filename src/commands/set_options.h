// Adds the options that change the configuration.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace understudy::commands {

// The values of these options, as typed.
struct SetArguments {
  std::vector<std::string> config_files;
  std::vector<std::string> sets;             // "key=value"; short options come before --set
  std::map<std::string, std::string> typed;  // how such a short option was typed: "--start lying"
};

// For all functions: parsing fills `arguments`, which must outlive `app`.

// Adds an option that is short for a --set of `key`. An explicit --set of that key overrides it.
CLI::Option* AddShortOption(CLI::App* app, SetArguments* arguments, const std::string& option,
                            const std::string& key, const std::string& type,
                            const std::string& help);

// Adds --profile.
void AddProfileOption(CLI::App* app, SetArguments* arguments);

// Adds --set KEY=VALUE, which sets `what`, as in "one key".
void AddSetOption(CLI::App* app, SetArguments* arguments, const std::string& what);

// Adds --config FILE and --set KEY=VALUE, with an example of the latter.
void AddSetOptions(CLI::App* app, SetArguments* arguments, const std::string& config_help,
                   const std::string& example);

}  // namespace understudy::commands
