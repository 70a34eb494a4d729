#include <vector>

#include "base/nearest_word.h"
#include "commands/commands.h"

namespace understudy::commands {
namespace {

// The program and the subcommands so far, each of which may define an option.
using Path = std::vector<const CLI::App*>;

const CLI::Option* FindOption(const Path& path, const std::string& word) {
  for (const CLI::App* app : path) {
    if (const CLI::Option* option = app->get_option_no_throw(word)) return option;
  }
  return nullptr;
}

// Returns whether the word is an option that takes the next word as its value.
bool TakesNext(const Path& path, const std::string& word) {
  const CLI::Option* option = FindOption(path, word);
  return option != nullptr && option->get_items_expected_min() > 0;
}

const CLI::App* Child(const CLI::App& app, const std::string& word) {
  const auto named =
      app.get_subcommands([&](const CLI::App* child) { return child->check_name(word); });
  return named.empty() ? nullptr : named.front();
}

}  // namespace

std::string MissingCommand(const CLI::App& app, int argc, const char* const* argv) {
  Path path = {&app};
  std::string of = app.get_name();
  std::string typed;
  for (int i = 1; i < argc && typed.empty(); ++i) {
    const std::string word = argv[i];
    if (word.starts_with('-')) {
      if (TakesNext(path, word)) ++i;
      continue;
    }
    if (const CLI::App* child = Child(*path.back(), word)) {
      path.push_back(child);
      of += " " + word;
    } else {
      typed = word;
    }
  }
  std::vector<std::string> words;
  for (const CLI::App* child : path.back()->get_subcommands({})) words.push_back(child->get_name());
  if (words.empty()) return "";
  const std::string what = typed.empty() ? "a command is missing after `" + of + "`"
                                         : "no command '" + typed + "' of `" + of + "`";
  return what + DidYouMean(typed, words);
}

std::string UnknownOption(const CLI::App& app, int argc, const char* const* argv) {
  Path path = {&app};
  std::string of = app.get_name();
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--") break;
    if (const CLI::App* child = Child(*path.back(), word)) {
      path.push_back(child);
      of += " " + word;
      continue;
    }
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || FindOption(path, name) != nullptr) continue;
    std::vector<std::string> words;
    for (const CLI::App* parent : path) {
      for (const CLI::Option* option : parent->get_options()) {
        for (const std::string& known : option->get_lnames()) words.push_back("--" + known);
      }
    }
    const std::string nearest = NearestWord(name, words);
    return "no option '" + name + "' of `" + of + "`" +
           (nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
  }
  return "";
}

}  // namespace understudy::commands
