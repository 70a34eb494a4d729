// A command line that is being typed, for completions.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/command_path.h"

namespace understudy::commands {

using Words = std::vector<std::string>;

struct Typed {
  CommandPath path;
  std::string command;                       // "ctl crane"; "" for the program itself
  Words places;                              // the words of the last command that are no options
  std::map<std::string, std::string> given;  // values of options
  const CLI::Option* option = nullptr;       // whose value the last word is; null for none
  std::string before;                        // "--speed=" of the last word, which stays as it is
  std::string last;                          // the rest of it; may be ""
  std::size_t broken = 0;                    // so much of the last word the shell has as others
  bool free = false;                         // the words of another program follow
};

// Reads the words behind the program's name as a shell has them; the last may be "". Those that
// take a value are followed by it, or have it behind a "=", at which the shell may break words.
Typed ReadTyped(const CLI::App& app, const Words& given);

}  // namespace understudy::commands
