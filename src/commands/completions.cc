#include "commands/completions.h"

#include <sstream>
#include <stdexcept>

namespace understudy {
namespace {

// A subcommand as the user types it, with the words that may follow.
struct Branch {
  std::string path;  // "ctl crane"; "" for the program itself
  std::vector<std::string> words;
};

void Collect(const CLI::App& app, const std::string& path, const std::vector<std::string>& robots,
             std::vector<Branch>* branches) {
  Branch branch{.path = path, .words = {}};
  for (const CLI::App* child : app.get_subcommands({})) branch.words.push_back(child->get_name());
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) branch.words.push_back("--" + name);
    if (option->get_name() == "robot") {
      branch.words.insert(branch.words.end(), robots.begin(), robots.end());
    }
  }
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

// Both shells walk the words typed so far down the subcommands they know.
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

std::string Fish(const std::string& name, const std::vector<Branch>& branches) {
  std::ostringstream out;
  for (const Branch& branch : branches) {
    const std::string condition = branch.path.empty()
                                      ? "__fish_use_subcommand"
                                      : "__fish_seen_subcommand_from " + branch.path;
    for (const std::string& word : branch.words) {
      out << "complete -c " << name << " -n '" << condition << "' ";
      if (word.rfind("--", 0) == 0) {
        out << "-l " << word.substr(2) << "\n";
      } else {
        out << "-a " << word << "\n";
      }
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
  // zsh runs bash completions by its own compatibility layer.
  if (shell == "zsh") return "autoload -U +X bashcompinit && bashcompinit\n" + Bash(name, branches);
  if (shell == "fish") return Fish(name, branches);
  throw std::invalid_argument("no completions for '" + shell + "': bash, zsh or fish");
}

}  // namespace understudy
