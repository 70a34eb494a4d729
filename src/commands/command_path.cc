#include "commands/command_path.h"

namespace understudy::commands {

const CLI::Option* FindOption(const CommandPath& path, const std::string& name) {
  for (auto app = path.rbegin(); app != path.rend(); ++app) {
    if (const CLI::Option* option = (*app)->get_option_no_throw(name)) return option;
  }
  return nullptr;
}

bool TakesNext(const CommandPath& path, const std::string& word) {
  const CLI::Option* option = FindOption(path, word);
  return option != nullptr && option->get_items_expected_min() > 0;
}

const CLI::App* FindCommand(const CLI::App& app, const std::string& name) {
  const auto named =
      app.get_subcommands([&](const CLI::App* child) { return child->check_name(name); });
  return named.empty() ? nullptr : named.front();
}

std::vector<std::string> CommandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* child : app.get_subcommands({})) {
    if (!child->get_group().empty()) names.push_back(child->get_name());
  }
  return names;
}

std::vector<std::string> OptionNames(const CommandPath& path) {
  std::vector<std::string> names;
  for (const CLI::App* app : path) {
    for (const CLI::Option* option : app->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  return names;
}

}  // namespace understudy::commands
