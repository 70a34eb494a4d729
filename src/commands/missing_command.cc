#include <algorithm>
#include <vector>

#include "base/nearest_word.h"
#include "commands/command_path.h"
#include "commands/commands.h"
#include "config/data_dir.h"
#include "config/robots.h"

namespace understudy::commands {
std::string MissingCommand(const CLI::App& app, int argc, const char* const* argv) {
  CommandPath path = {&app};
  std::string of = app.get_name();
  std::string typed;
  for (int i = 1; i < argc && typed.empty(); ++i) {
    const std::string word = argv[i];
    if (word.starts_with('-')) {
      if (TakesNext(path, word)) ++i;
      continue;
    }
    if (const CLI::App* child = FindCommand(*path.back(), word)) {
      path.push_back(child);
      of += " " + word;
    } else {
      typed = word;
    }
  }
  const std::vector<std::string> words = CommandNames(*path.back());
  if (words.empty()) return "";
  const std::string what = typed.empty() ? "a command is missing after `" + of + "`"
                                         : "no command '" + typed + "' of `" + of + "`";
  if (path.size() == 1 && std::ranges::count(config::RobotNames(config::DataDir()), typed) > 0) {
    return what + "; did you mean `understudy run " + typed + "`?";
  }
  return what + DidYouMean(typed, words);
}

std::string UnknownOption(const CLI::App& app, int argc, const char* const* argv) {
  CommandPath path = {&app};
  std::string of = app.get_name();
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--") break;
    if (const CLI::App* child = FindCommand(*path.back(), word)) {
      path.push_back(child);
      of += " " + word;
      continue;
    }
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || FindOption(path, name) != nullptr) continue;
    return "no option '" + name + "' of `" + of + "`" + NearestHint(name, OptionNames(path));
  }
  return "";
}

}  // namespace understudy::commands
