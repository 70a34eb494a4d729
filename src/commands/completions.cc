#include "commands/completions.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "emulator/request.h"

namespace understudy::commands {
namespace {

// A subcommand as the user types it, with the words that may follow.
struct Branch {
  std::string path;  // "ctl crane"; "" for the program itself
  std::vector<std::string> words;
  bool has_subcommands = false;
};

// What the first value of a request may be, where that is one of few words.
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

// All shells walk the words typed so far down the subcommands they know.
std::string Bash(const std::string& name, const std::vector<Branch>& branches) {
  std::ostringstream out;
  // No `path` and no `mapfile`: zsh keeps its PATH in the one and has not the other.
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

// zsh runs bash completions by a layer of its own, which needs the completion system started.
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
    // Where subcommands follow no file does.
    if (branch.has_subcommands) out << begin << "-f\n";
    for (const std::string& word : branch.words) {
      const bool option = word.starts_with("--");
      out << begin << (option ? "-l " + word.substr(2) : "-a " + word) << "\n";
    }
  }
  return out.str();
}

}  // namespace

std::string Completions(const CLI::App& app, const std::string& shell,
                        const std::vector<std::string>& robots) {
  std::vector<Branch> branches;
  Collect(app, "", robots, &branches);
  const std::string& name = app.get_name();
  if (shell == "bash") return Bash(name, branches);
  if (shell == "zsh") return kZshPreamble + Bash(name, branches);
  if (shell == "fish") return Fish(name, branches);
  throw std::invalid_argument("no completions for '" + shell + "': bash, zsh or fish");
}

}  // namespace understudy::commands
