#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "bus/interfaces.h"
#include "client/client.h"
#include "client/robot_choice.h"
#include "commands/commands.h"
#include "commands/typed.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "config/profile.h"
#include "config/reference.h"
#include "config/robot_file.h"
#include "emulator/live_settings.h"
#include "emulator/request.h"
#include "emulator/snapshot.h"
#include "robot/remote_keys.h"
#include "robot/start_pose.h"
#include "server/request_docs.h"
#include "terrain/terrain.h"
#include "wire/robot_topics.h"

namespace understudy::commands {
namespace {

// ---- the values of options and places

Words Robots(const Typed&) { return config::RobotNames(config::DataDir()); }

Words Revisions(const Typed& typed) {
  if (typed.places.empty()) return {};
  return config::ReadRobotFile(typed.places.front(), config::DataDir()).RevisionNames();
}

Words Hands(const Typed& typed) {
  if (typed.places.empty()) return {};
  const config::Layers layers{.robot = typed.places.front()};
  Words names = config::LoadConfig(layers, config::DataDir()).robots[0].spec.hand_makes;
  names.emplace_back("none");
  return names;
}

Words Scenes(const Typed&) { return terrain::GeneratedScenes(); }

Words Scenarios(const Typed&) {
  return schema::YamlNames(config::DataDir() / "config" / "scenarios");
}

Words Interfaces(const Typed&) {
  Words names;
  for (const bus::NetworkInterface& one : bus::ListInterfaces()) names.push_back(one.name);
  return names;
}

Words RunningRobots(const Typed& typed) {
  if (typed.command == "run" || typed.command == "exec") return {};  // theirs is a new name
  Words names;
  for (const client::RunningRobot& robot : client::FindRobots()) names.push_back(robot.name);
  return names;
}

Words Profiles(const Typed&) { return config::ProfileNames(config::DataDir()); }

Words MotionServices(const Typed& typed) {
  if (typed.places.empty()) return {};
  Words names{"none"};
  const config::Layers layers{.robot = typed.places.front()};
  for (const robot::ServiceSpec& service :
       config::LoadConfig(layers, config::DataDir()).robots[0].spec.services) {
    if (!service.alias.empty()) names.push_back(service.alias);
  }
  return names;
}

// Keys of the configuration with "=", or behind that the values of one.
Words Settings(const Typed& typed);

Words Poses(const Typed&) { return {robot::kStartPoses.begin(), robot::kStartPoses.end()}; }

Words Parts(const Typed&) {
  Words parts;
  for (const emulator::SnapshotPartName& part : emulator::kSnapshotParts) {
    parts.emplace_back(part.name);
  }
  return parts;
}

// The names in a list of the running robot's scene that the words choose; none if it does not
// answer soon.
Words NamesOf(const Typed& typed, const char* list) {
  constexpr std::chrono::milliseconds kPatience(500);
  const auto value = [&](const char* option) {
    const auto given = typed.given.find(option);
    return given == typed.given.end() ? std::string() : given->second;
  };
  const client::RobotChoice choice{.name = value("--name"), .socket = value("--socket")};
  if (choice.name.empty() && choice.socket.empty() && client::FindRobots().size() != 1) return {};
  const std::filesystem::path socket = client::ChosenSocket(choice);
  const auto scene = nlohmann::json::parse(
      client::Call(socket, "GET", "/scene", "", kPatience).body, nullptr, false);
  Words names;
  for (const auto& one : scene.value(list, nlohmann::json::array())) {
    names.push_back(one.value("name", ""));
  }
  return names;
}

Words Bodies(const Typed& typed) {
  Words names = NamesOf(typed, "bodies");
  if (!names.empty()) names.erase(names.begin());  // the world
  return names;
}

// Joints of motors of that robot.
Words Joints(const Typed& typed) { return NamesOf(typed, "motors"); }

// What `ctl fault` is said of most.
Words Components(const Typed& typed) {
  Words components = Joints(typed);
  components.insert(components.end(),
                    {"imu", "battery", "remote", std::string(wire::kLowCmdName), "all"});
  return components;
}

struct ValueRow {
  std::string_view name;  // of the option or place
  Words (*values)(const Typed& typed);
};
constexpr ValueRow kValues[] = {
    {"robot", Robots},
    {"--robot", Robots},
    {"--like", Robots},
    {"--revision", Revisions},
    {"--hands", Hands},
    {"scene", Scenes},
    {"--scene", Scenes},
    {"scenario", Scenarios},
    {"--set", Settings},
    {"--interface", Interfaces},
    {"--name", RunningRobots},
    {"--start", Poses},
    {"--parts", Parts},
    {"--track", Bodies},
    {"--speed", [](const Typed&) { return Words{"max"}; }},
    {"--messages",
     [](const Typed&) {
       return Words{"go", "hg"};
     }},
    {"--profile", Profiles},
    {"--dynamics",
     [](const Typed&) {
       return Words{"catalogue", "fitted"};
     }},
    {"--keep",
     [](const Typed&) {
       return Words{"failures", "all", "none"};
     }},
    {"--log-level",
     [](const Typed&) {
       return Words{"debug", "info", "warn", "error"};
     }},
    {"shell",
     [](const Typed&) {
       return Words{"bash", "zsh", "fish"};
     }},
};

// Those of keys that take names.
constexpr ValueRow kKeyValues[] = {
    {"profile", Profiles},
    {"scene", Scenes},
    {"robot.revision", Revisions},
    {"robot.hand_make", Hands},
    {"network.interface", Interfaces},
    {"motion.service", MotionServices},
};

Words Settings(const Typed& typed) {
  Words words;
  const std::size_t equals = typed.last.find('=');
  if (equals == std::string::npos) {
    for (const std::string& key : config::ConfigKeys()) {
      if (key.find("[]") == std::string::npos) words.push_back(key + "=");
    }
    return words;
  }
  const std::string key = typed.last.substr(0, equals);
  const auto* row = std::ranges::find(kKeyValues, key, &ValueRow::name);
  words = row == std::end(kKeyValues) ? config::WordsOfKey(key) : row->values(typed);
  std::erase(words, "");
  for (std::string& word : words) word.insert(0, key + "=");
  return words;
}

// Chords that continue the last word: "L2+A", "L2+B" ...
Words Chords(const Typed& typed) {
  const std::string begun = typed.last.substr(0, typed.last.rfind('+') + 1);
  Words chords;
  for (const std::string_view key : robot::kRemoteKeys) chords.push_back(begun + std::string(key));
  return chords;
}

Words ValuesOf(const schema::Field& field, const Typed& typed) {
  if (field.type == &schema::kSwitch) return {"on", "off"};
  if (field.type == &schema::kWord) return {field.words.begin(), field.words.end()};
  if (field.type == &emulator::types::kSpeed) return {"max"};
  if (field.type == &emulator::types::kKeys || field.type == &emulator::types::kMaybeKeys)
    return Chords(typed);
  if (field.type == &emulator::types::kBody) return Bodies(typed);
  if (field.key == "joint") return Joints(typed);
  if (field.key == "component") return Components(typed);
  if (field.type == &emulator::types::kSetting) {
    Words keys;
    for (const emulator::LiveSetting& one : emulator::LiveSettings()) keys.emplace_back(one.key);
    return keys;
  }
  if (field.type == &emulator::types::kValue && !typed.places.empty()) {
    return config::WordsOfKey(typed.places[0]);
  }
  return {};
}

// Returns the request of that command, "ctl crane lower"; null for another command.
const emulator::RequestRow* RequestOf(const std::string& command) {
  constexpr std::string_view kCtl = "ctl ";
  if (!command.starts_with(kCtl)) return nullptr;
  std::string name = command.substr(kCtl.size());
  std::ranges::replace(name, ' ', '.');
  const auto row = emulator::FindRequest(name);
  return row ? *row : nullptr;
}

Words ValuesOf(const CLI::Option& option, const Typed& typed) {
  const std::string name = option.get_name();
  if (const emulator::RequestRow* row = RequestOf(typed.command)) {
    for (const schema::Field& field : row->fields) {
      const bool is =
          name == (field.bare ? server::Capitals(field.key) : "--" + std::string(field.key));
      if (is) return ValuesOf(field, typed);
    }
  }
  const auto* row = std::ranges::find(kValues, name, &ValueRow::name);
  return row == std::end(kValues) ? Words() : row->values(typed);
}

// The place of the last word among those of the last command.
const CLI::Option* PlaceOf(const Typed& typed) {
  const auto places = typed.path.back()->get_options(
      [](const CLI::Option* option) { return option->get_positional(); });
  std::size_t before = typed.places.size();
  for (const CLI::Option* place : places) {
    const auto most = static_cast<std::size_t>(place->get_items_expected_max());
    if (before < most) return place;
    before -= most;
  }
  return nullptr;
}

// What may stand in the place of the last word; none where anything may, as a file.
Words Candidates(const Typed& typed) {
  if (typed.free) return {};
  if (typed.option != nullptr) return ValuesOf(*typed.option, typed);
  if (!typed.before.empty()) return {};  // of an option that is not there
  if (typed.last.starts_with('-')) return OptionNames(typed.path);
  if (Words commands = CommandNames(*typed.path.back()); !commands.empty()) return commands;
  const CLI::Option* const place = PlaceOf(typed);
  return place == nullptr ? Words() : ValuesOf(*place, typed);
}

// Prints those that begin as the last word does, one a line, of a word that the shell has broken
// the last part. Nobody wants to read of an error.
int CompleteCommand(const CLI::App& app, const Words& words) {
  try {
    const Typed typed = ReadTyped(app, words);
    for (const std::string& word : Candidates(typed)) {
      if (!word.starts_with(typed.last)) continue;
      std::puts((typed.before + word).substr(typed.broken).c_str());
    }
  } catch (const std::exception&) {
  }
  return 0;
}

// ---- the scripts, which ask the program that is typed

// In bash and zsh, which runs it through bashcompinit. It uses nothing that zsh lacks: no variable
// `path`, which is PATH there, no `mapfile`, no process substitution.
constexpr char kBash[] = R"sh(_understudy() {
  COMPREPLY=($("${COMP_WORDS[0]}" complete -- "${COMP_WORDS[@]:1:$COMP_CWORD}" 2>/dev/null))
  case "${#COMPREPLY[@]} ${COMPREPLY[0]}" in
    1\ *=) compopt -o nospace 2>/dev/null ;;
  esac
}
complete -o default -F _understudy understudy
)sh";

// Sourced, or a file _understudy in zsh's fpath: its text is then the first call of that function,
// which it replaces by the one above and calls.
constexpr char kZshPreamble[] =
    "#compdef understudy\n"
    "(( $+functions[compdef] )) || { autoload -U +X compinit && compinit }\n"
    "autoload -U +X bashcompinit && bashcompinit\n";
constexpr char kZshEnd[] =
    "[[ $funcstack[1] != _understudy ]] || _bash_complete -o default -F _understudy\n";

constexpr char kFish[] = R"sh(function __understudy_words
  set -l words (commandline -opc)
  $words[1] complete -- $words[2..-1] "$(commandline -ct)" 2>/dev/null
end
complete -c understudy -n 'count (__understudy_words) >/dev/null' -f
complete -c understudy -a '(__understudy_words)'
)sh";

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
      "  source <(understudy completions zsh)          in ~/.zshrc\n"
      "They ask the program: names of robots, scenes, keys of --set and their words, bodies of a\n"
      "running robot.");
  const auto print = [=] {
    const std::string script = *shell == "fish"  ? kFish
                               : *shell == "zsh" ? std::string(kZshPreamble) + kBash + kZshEnd
                                                 : kBash;
    std::fputs(script.c_str(), stdout);
    return 0;
  };
  completions->callback([=] { *chosen = print; });

  const auto words = std::make_shared<Words>();
  CLI::App* complete = app->add_subcommand("complete", "What a shell's completion asks");
  complete->group("");
  complete->add_option("words", *words);
  complete->callback([=] { *chosen = [=] { return CompleteCommand(*app, *words); }; });
}

}  // namespace understudy::commands
