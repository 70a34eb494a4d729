#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "commands/commands.h"
#include "config/data_dir.h"
#include "config/robot_file.h"
#include "emulator/request.h"

namespace understudy::commands {
namespace {

// A subcommand as typed, with the words that may follow.
struct Branch {
  std::string path;  // "ctl crane"; "" for the program itself
  std::vector<std::string> words;
  bool has_subcommands = false;
};

// Adds the valid words of a request's first value, if it takes words.
void AddValues(const std::string& path, std::vector<std::string>* words) {
  constexpr std::string_view kCtl = "ctl ";
  if (!path.starts_with(kCtl)) return;
  std::string name = path.substr(kCtl.size());
  std::ranges::replace(name, ' ', '.');
  const auto row = emulator::FindRequest(name);
  if (!row || (*row)->fields.empty()) return;
  const emulator::Field& first = (*row)->fields.front();
  words->insert(words->end(), first.words.begin(), first.words.end());
  if (first.kind == emulator::FieldKind::kSwitch) words->insert(words->end(), {"on", "off"});
}

void Collect(const CLI::App& app, const std::string& path, const std::vector<std::string>& robots,
             std::vector<Branch>* branches) {
  Branch branch{.path = path, .words = {}, .has_subcommands = !app.get_subcommands({}).empty()};
  for (const CLI::App* child : app.get_subcommands({})) branch.words.push_back(child->get_name());
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) branch.words.push_back("--" + name);
    if (option->get_name() == "robot") {
      branch.words.insert(branch.words.end(), robots.begin(), robots.end());
    }
  }
  AddValues(path, &branch.words);
  branches->push_back(branch);
  for (const CLI::App* child : app.get_subcommands({})) {
    Collect(*child, path.empty() ? child->get_name() : path + " " + child->get_name(), robots,
            branches);
  }
}

std::string Join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

// The scripts of all shells find the subcommand by matching the words typed so far.
std::string Bash(const std::string& name, const std::vector<Branch>& branches) {
  std::ostringstream out;
  // Uses neither a variable `path`, which is PATH in zsh, nor `mapfile`, which zsh lacks.
  out << "_" << name << "() {\n  local typed=\"\" word words\n"
      << "  for word in \"${COMP_WORDS[@]:1:$((COMP_CWORD - 1))}\"; do\n"
      << "    [[ $word == -* ]] && continue\n    case \"${typed:+$typed }$word\" in\n";
  for (const Branch& branch : branches) {
    if (!branch.path.empty())
      out << "      '" << branch.path << "') typed='" << branch.path << "' ;;\n";
  }
  out << "    esac\n  done\n  case \"$typed\" in\n";
  for (const Branch& branch : branches) {
    out << "    '" << branch.path << "') words='" << Join(branch.words) << "' ;;\n";
  }
  out << "  esac\n"
      << "  COMPREPLY=($(compgen -W \"$words\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n}\n"
      << "complete -o default -F _" << name << " " << name << "\n";
  return out.str();
}

// zsh runs bash completions through bashcompinit, which needs compinit.
constexpr char kZshPreamble[] =
    "(( $+functions[compdef] )) || { autoload -U +X compinit && compinit }\n"
    "autoload -U +X bashcompinit && bashcompinit\n";

std::string Fish(const std::string& name, const std::vector<Branch>& branches) {
  const std::string path = "__" + name + "_path";
  std::ostringstream out;
  out << "function " << path << "\n  set -l typed ''\n"
      << "  for word in (commandline -opc)[2..-1]\n"
      << "    switch (string trim \"$typed $word\")\n      case";
  for (const Branch& branch : branches) {
    if (!branch.path.empty()) out << " '" << branch.path << "'";
  }
  out << "\n        set typed (string trim \"$typed $word\")\n    end\n  end\n  echo $typed\nend\n";
  for (const Branch& branch : branches) {
    const std::string begin =
        "complete -c " + name + " -n 'test (" + path + ") = \"" + branch.path + "\"' ";
    // No file names where a subcommand must follow.
    if (branch.has_subcommands) out << begin << "-f\n";
    for (const std::string& word : branch.words) {
      const bool option = word.starts_with("--");
      out << begin << (option ? "-l " + word.substr(2) : "-a " + word) << "\n";
    }
  }
  return out.str();
}

}  // namespace

void AddCompletionsCommand(CLI::App* app, Chosen* chosen) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* completions = app->add_subcommand("completions", "Print completions for a shell");
  completions->add_option("shell", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  completions->footer(
      "Examples:\n"
      "  understudy completions bash > ~/.local/share/bash-completion/completions/understudy\n"
      "  understudy completions fish > ~/.config/fish/completions/understudy.fish\n"
      "  source <(understudy completions zsh)          in ~/.zshrc");
  const auto print = [=] {
    std::vector<Branch> branches;
    Collect(*app, "", config::RobotNames(config::DataDir()), &branches);
    const std::string name = app->get_name();
    const std::string script = *shell == "fish" ? Fish(name, branches) : Bash(name, branches);
    std::fputs(((*shell == "zsh" ? kZshPreamble : "") + script).c_str(), stdout);
    return 0;
  };
  completions->callback([=] { *chosen = print; });
}

}  // namespace understudy::commands
