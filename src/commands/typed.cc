#include "commands/typed.h"

namespace understudy::commands {
namespace {

// Joins what a shell has broken at "=": bash gives "--speed=2" in three words, "--speed=" in two.
Words Joined(const Words& words, std::size_t* broken) {
  Words joined;
  bool goes_on = false;
  for (const std::string& word : words) {
    *broken = 0;
    if (word == "=" && !joined.empty() && !goes_on) {
      joined.back() += word;
      *broken = joined.back().size();
    } else if (goes_on) {
      *broken = joined.back().size();
      joined.back() += word;
    } else {
      joined.push_back(word);
    }
    goes_on = word == "=";
  }
  return joined;
}

}  // namespace

Typed ReadTyped(const CLI::App& app, const Words& given) {
  Typed typed;
  typed.path = {&app};
  const Words words = Joined(given, &typed.broken);
  if (!words.empty()) typed.last = words.back();
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--") typed.free = true;
    if (typed.free) break;
    if (word.starts_with('-')) {
      const std::size_t equals = word.find('=');
      if (equals != std::string::npos) {
        typed.given[word.substr(0, equals)] = word.substr(equals + 1);
      } else if (!TakesNext(typed.path, word)) {
        continue;
      } else if (i + 2 < words.size()) {
        typed.given[word] = words[++i];
      } else {
        typed.option = FindOption(typed.path, word);
      }
    } else if (const CLI::App* child = FindCommand(*typed.path.back(), word)) {
      typed.path.push_back(child);
      typed.command += (typed.command.empty() ? "" : " ") + word;
    } else {
      typed.places.push_back(word);
    }
  }
  const std::size_t equals = typed.last.find('=');
  if (typed.option == nullptr && typed.last.starts_with('-') && equals != std::string::npos) {
    typed.option = FindOption(typed.path, typed.last.substr(0, equals));
    typed.before = typed.last.substr(0, equals + 1);
    typed.last.erase(0, equals + 1);
  }
  return typed;
}

}  // namespace understudy::commands
