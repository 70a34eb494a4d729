#include <vector>

#include "base/nearest_word.h"
#include "commands/commands.h"

namespace understudy::commands {
namespace {

// Whether the word is an option that takes the next one as its value. `path`: the program and the
// subcommands so far, any of which may know it.
bool TakesNext(const std::vector<const CLI::App*>& path, const std::string& word) {
  for (const CLI::App* app : path) {
    const CLI::Option* option = app->get_option_no_throw(word);
    if (option != nullptr) return option->get_items_expected_min() > 0;
  }
  return false;
}

}  // namespace

std::string MissingCommand(const CLI::App& app, int argc, const char* const* argv) {
  std::vector<const CLI::App*> path = {&app};
  std::string of = app.get_name();
  std::string typed;
  for (int i = 1; i < argc && typed.empty(); ++i) {
    const std::string word = argv[i];
    if (word.starts_with('-')) {
      if (TakesNext(path, word)) ++i;
      continue;
    }
    const std::vector<const CLI::App*> named = path.back()->get_subcommands(
        [&](const CLI::App* child) { return child->check_name(word); });
    if (named.empty()) {
      typed = word;
    } else {
      path.push_back(named.front());
      of += " " + word;
    }
  }
  std::vector<std::string> words;
  for (const CLI::App* child : path.back()->get_subcommands({})) words.push_back(child->get_name());
  if (words.empty()) return "";
  const std::string what = typed.empty() ? "a command is missing after `" + of + "`"
                                         : "no command '" + typed + "' of `" + of + "`";
  return what + DidYouMean(typed, words);
}

}  // namespace understudy::commands
