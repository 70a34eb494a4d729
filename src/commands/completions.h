// Writes shell completions from the command line's own description.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace understudy::commands {

// Returns a script for `bash`, `zsh` or `fish` that completes subcommands, options and, where a
// robot's name is expected, `robots`. Throws std::invalid_argument for another shell.
std::string Completions(const CLI::App& app, const std::string& shell,
                        const std::vector<std::string>& robots);

}  // namespace understudy::commands
