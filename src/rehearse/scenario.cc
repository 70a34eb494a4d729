#include "rehearse/scenario.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <system_error>
#include <utility>

#include "base/errors.h"
#include "config/data_dir.h"
#include "rehearse/evidence.h"
#include "rehearse/with_settings.h"
#include "rehearse/yaml_values.h"

namespace understudy::rehearse {
namespace {

using config::YamlValue;
using Kind = YamlValue::Kind;

// Letters; *assumed*.
constexpr std::size_t kMostTitle = 80;
constexpr std::size_t kMostText = 400;
constexpr double kLongestProgram = 600;  // s of a program that nothing else ends; *assumed*

struct ScenarioKey {
  std::string_view key, takes, says;
};
constexpr ScenarioKey kScenarioKeys[] = {
    {"scenario", "a text", "Its title; needed"},
    {"about", "a sentence", "What it shows"},
    {"robot", "a robot's name or YAML file", "Needed"},
    {"revision", "a revision's name",
     "Of the robot's hardware, as `understudy robots` lists them; the robot's default unless "
     "given"},
    {"start", "lying, standing, hanging, clamped", "Start pose; the robot's default unless given"},
    {"seed", "a whole number", "Of randomization: randomization.seed"},
    {"profile", "ideal, nominal, worn, harsh",
     "How good the [sensors](sensors.md) are; nominal unless given"},
    {"faults", "a list", "What [fails](faults.md) from the start, or planned with `at`"},
    {"scene", "a kind of terrain or a file",
     "Ground; a file is looked for beside the scenario first"},
    {"speed", "a number, or max",
     "Simulated seconds per wall second: max, or 1 with a program, unless given"},
    {"duration", "seconds", "After which the rehearsal ends; needed without a program"},
    {"settings", "a mapping", "Further keys of the configuration, as in a file for --config"},
    {"program", "a mapping", "The program under test, see below"},
    {"script", "a list", "What happens when, as in a [script](scripts.md)"},
    {"expect", "a list", "Expectations, see below; needed"},
    {"stages", "a list", "The [ladder](#stages) to a real robot, each stage with its limits"},
    {"vary", "a mapping", "How the runs of a [campaign](#campaigns) differ"},
};
constexpr ScenarioKey kProgramKeys[] = {
    {"command", "a list of words", "Program and arguments; `-- CMD...` replaces it"},
    {"at", "seconds", "When it starts; 0 unless given"},
    {"until", "seconds", "When it is ended; it ends by itself unless given"},
    {"by", "term or kill", "How: SIGTERM, and SIGKILL 0.5 s later, unless given; or SIGKILL"},
    {"limit", "seconds",
     "From its start, in which it has to end by itself: an expectation like the others; 600 unless "
     "given, and none beside `until` or `duration`"},
};

template <std::size_t kCount>
void RefuseUnknown(const YamlValue& map, const ScenarioKey (&rows)[kCount]) {
  std::vector<std::string> known;
  for (const ScenarioKey& row : rows) known.emplace_back(row.key);
  RefuseOthers(map, known);
}

const YamlValue& Needed(const YamlValue& map, const std::string& key) {
  const YamlValue* value = map.Find(key);
  if (value == nullptr) throw ConfigError(map.where + ": " + key + ": missing");
  return *value;
}

// The value as the configuration's key "a.b".
YamlValue TreeOf(const std::string& outer, const std::string& inner, const YamlValue& value) {
  YamlValue tree = inner.empty() ? value : config::MapOf(inner, value);
  return config::MapOf(outer, std::move(tree));
}

YamlValue ScalarOf(std::string text, const std::string& where) {
  YamlValue value;
  value.kind = Kind::kScalar;
  value.text = std::move(text);
  value.where = where;
  return value;
}

// A file beside the scenario comes before one that the working folder has.
YamlValue SceneBeside(const std::filesystem::path& file, YamlValue scene) {
  std::error_code error;
  const std::filesystem::path beside = file.parent_path() / scene.text;
  if (scene.kind == Kind::kScalar && std::filesystem::is_regular_file(beside, error)) {
    scene.text = std::filesystem::absolute(beside);
  }
  return scene;
}

Program ReadProgram(const YamlValue& value) {
  if (value.kind == Kind::kNull) return {};
  if (value.kind != Kind::kMap) {
    Refuse(value, "program", "a mapping, as in {command: [python3, walk.py, lo]}");
  }
  RefuseUnknown(value, kProgramKeys);
  Program program;
  if (const YamlValue* command = value.Find("command")) {
    if (command->kind != Kind::kSequence || command->items.empty()) {
      Refuse(*command, "command", "a list of words, as in [python3, walk.py, lo]");
    }
    for (const YamlValue& word : command->items) {
      if (word.kind != Kind::kScalar) Refuse(word, "command", "a word");
      program.command.push_back(word.text);
    }
  }
  if (const YamlValue* at = value.Find("at")) program.at = SecondsOf(*at, "program.at");
  if (const YamlValue* until = value.Find("until")) {
    program.until = SecondsOf(*until, "program.until");
    if (*program.until < program.at) {
      throw ConfigError(until->where + ": program.until: it would end before it starts");
    }
  }
  if (const YamlValue* limit = value.Find("limit")) {
    program.limit = SecondsOf(*limit, "program.limit");
  }
  if (const YamlValue* by = value.Find("by")) {
    if (by->text != "term" && by->text != "kill") Refuse(*by, "program.by", "term or kill");
    program.kill = by->text == "kill";
  }
  return program;
}

// In which the program has to end by itself; nullopt where something else ends the rehearsal.
std::optional<double> LimitOf(const Program& program, const config::Config& config) {
  if (program.limit || program.until || config.time.duration > 0) return program.limit;
  return kLongestProgram;
}

// What is expected: what the file says, and that the program ends in its time.
Expectations ExpectationsOf(const YamlValue& document, const Names& names,
                            const std::optional<double>& limit) {
  YamlValue list = Needed(document, "expect");
  if (limit && list.kind == Kind::kSequence && !list.items.empty()) {
    const YamlValue* program = document.Find("program");
    const std::string where = program == nullptr ? document.where : program->where;
    std::array<char, 32> seconds{};
    std::snprintf(seconds.data(), seconds.size(), "%.9g", *limit);
    YamlValue ends = config::MapOf("eventually", ScalarOf("program_end happens", where));
    const auto add = [&](const char* key, const std::string& text) {
      ends.keys.push_back(ScalarOf(key, where));
      ends.items.push_back(ScalarOf(text, where));
    };
    add("from", "program_start happens");
    add("within", seconds.data());
    add("name", "the program ends within " + std::string(seconds.data()) + " s");
    ends.where = where;
    list.items.push_back(std::move(ends));
  }
  return ReadExpectations(list, names);
}

// The configuration that a scenario describes; `run` as Scenario has it.
config::Config ConfigOf(const YamlValue& document, const std::filesystem::path& file,
                        const ScenarioOptions& options, bool has_program, std::size_t run) {
  config::Layers layers{.robot = LineOf(Needed(document, "robot"), "robot", kMostText),
                        .sets = options.sets,
                        .typed = options.typed};
  const std::string& where = document.where;
  if (run > 0) {
    layers.trees.push_back(TreeOf("randomization", "seed", ScalarOf(std::to_string(run), where)));
  }
  const YamlValue* speed = document.Find("speed");
  const YamlValue pace = speed != nullptr ? *speed : ScalarOf(has_program ? "1" : "max", where);
  layers.trees.push_back(
      TreeOf("time", "speed", pace.text == "max" ? ScalarOf("0", pace.where) : pace));
  if (const YamlValue* settings = document.Find("settings")) {
    if (settings->kind != Kind::kMap) Refuse(*settings, "settings", "a mapping of keys");
    layers.trees.push_back(*settings);
  }
  const auto add = [&](const char* key, const char* outer, const char* inner) {
    const YamlValue* value = document.Find(key);
    if (value != nullptr) layers.trees.push_back(TreeOf(outer, inner, *value));
  };
  add("revision", "robot", "revision");
  add("start", "start", "pose");
  add("profile", "profile", "");
  add("faults", "faults", "");
  add("seed", "randomization", "seed");
  add("duration", "time", "duration");
  if (const YamlValue* scene = document.Find("scene")) {
    layers.trees.push_back(TreeOf("scene", "", SceneBeside(file, *scene)));
  }
  return config::LoadConfig(layers, config::DataDir());
}

YamlValue ReadDocument(const std::filesystem::path& file) {
  YamlValue document = config::ReadYamlFile(file);
  if (document.kind != Kind::kMap) {
    throw ConfigError(document.where + ": expected a scenario: a mapping with the key expect");
  }
  RefuseUnknown(document, kScenarioKeys);
  return document;
}

// A run of a campaign, or the scenario itself.
struct Chosen {
  YamlValue document;
  std::optional<Plan> plan{};
  std::size_t run = 0;
  std::vector<Setting> settings{};
  ScenarioOptions options{};
};

Chosen Choose(const YamlValue& document, const ScenarioOptions& options, bool knows_command) {
  Chosen chosen{.document = document, .options = options};
  const YamlValue* vary = document.Find("vary");
  if (vary == nullptr) {
    if (options.run == 0) return chosen;
    throw ConfigError(document.where + ": vary: missing, so there is no run " +
                      std::to_string(options.run));
  }
  chosen.plan.emplace(*vary);
  chosen.run = std::max<std::size_t>(options.run, 1);
  if (chosen.run > chosen.plan->size()) {
    throw ConfigError(vary->where + ": vary: there is no run " + std::to_string(chosen.run) +
                      "; they are numbered from 1 to " + std::to_string(chosen.plan->size()));
  }
  chosen.settings = chosen.plan->Of(chosen.run);
  chosen.document = WithSettings(document, *chosen.plan, chosen.settings, &chosen.options.sets,
                                 knows_command ? &chosen.options.command : nullptr);
  return chosen;
}

// Reads the configuration; errors of the robot and of a varied key name their lines.
config::Config ConfigOf(const Chosen& chosen, const std::filesystem::path& file, bool has_program) {
  try {
    return ConfigOf(chosen.document, file, chosen.options, has_program, chosen.run);
  } catch (const ConfigError& error) {
    const std::string what = error.what();
    const YamlValue* robot = chosen.document.Find("robot");
    if (robot != nullptr && what.starts_with("robot '")) {
      throw ConfigError(robot->where + ": " + what);
    }
    for (std::size_t i = 0; i < chosen.settings.size(); ++i) {
      const auto& [key, text] = chosen.settings[i];
      const std::string start = "--set " + config::OneLine(key + "=" + text) + ": ";
      if (!what.starts_with(start)) continue;
      throw ConfigError(chosen.plan->axes()[i].where + ": vary: " + what.substr(start.size()));
    }
    throw;
  }
}

}  // namespace

bool IsScenario(const YamlValue& document) {
  return document.Find("expect") != nullptr || document.Find("scenario") != nullptr;
}

Scenario LoadScenario(const std::filesystem::path& file, const ScenarioOptions& options) {
  Chosen chosen = Choose(ReadDocument(file), options, true);
  const YamlValue& document = chosen.document;
  Scenario scenario{.file = file};
  scenario.name = LineOf(Needed(document, "scenario"), "scenario", kMostTitle);
  if (const YamlValue* about = document.Find("about"))
    scenario.about = LineOf(*about, "about", kMostText);
  if (const YamlValue* program = document.Find("program")) {
    scenario.program = ReadProgram(*program);
  }
  if (!chosen.options.command.empty()) {
    if (!scenario.program) scenario.program.emplace();
    scenario.program->command = chosen.options.command;
  }
  scenario.config = ConfigOf(chosen, file, scenario.program.has_value());
  if (!scenario.program && scenario.config.time.duration <= 0) {
    throw ConfigError(document.where +
                      ": duration: missing; expected seconds, as no program ends the rehearsal");
  }
  if (const YamlValue* script = document.Find("script")) {
    Names names = signals::RunningNames(scenario.config.robot);
    names.program = scenario.program.has_value();
    scenario.script = script::ReadEvents(*script, names);
  }
  Names names = signals::RecordedNames(scenario.config.robot, WrongField);
  names.program = scenario.program.has_value();
  if (scenario.program) scenario.program->limit = LimitOf(*scenario.program, scenario.config);
  scenario.expect =
      ExpectationsOf(document, names, scenario.program ? scenario.program->limit : std::nullopt);
  if (const YamlValue* stages = document.Find("stages")) scenario.stages = ReadStages(*stages);
  scenario.plan = std::move(chosen.plan);
  scenario.run = chosen.run;
  scenario.settings = std::move(chosen.settings);
  return scenario;
}

std::optional<VariedScenario> LoadVaried(const std::filesystem::path& file) {
  const YamlValue document = ReadDocument(file);
  const YamlValue* vary = document.Find("vary");
  if (vary == nullptr) return std::nullopt;
  VariedScenario varied{.name = LineOf(Needed(document, "scenario"), "scenario", kMostTitle),
                        .plan = Plan(*vary)};
  if (const YamlValue* about = document.Find("about")) {
    varied.about = LineOf(*about, "about", kMostText);
  }
  return varied;
}

Plan PlanOf(const std::string& text, const std::string& name) {
  return Plan(Needed(config::ParseYaml(text, name), "vary"));
}

void CheckRuns(const std::filesystem::path& file, const Plan& plan,
               const ScenarioOptions& options) {
  ScenarioOptions of_run = options;
  for (const std::size_t run : plan.Samples()) {
    of_run.run = run;
    try {
      LoadScenario(file, of_run);
    } catch (const ConfigError& error) {
      throw ConfigError(std::string(error.what()) + " (run " + std::to_string(run) + ": " +
                        SettingsText(plan.Of(run)) + ")");
    }
  }
}

Standard LoadStandard(const std::filesystem::path& file, const std::string& robot,
                      const std::string& revision, std::size_t run) {
  const Chosen chosen = Choose(ReadDocument(file), {.run = run}, false);
  const YamlValue& document = chosen.document;
  Standard standard;
  std::optional<double> limit;
  if (document.Find("robot") != nullptr) {
    standard.config = ConfigOf(chosen, file, true);
    // A scenario without a duration was played with a program, whoever named it.
    const YamlValue* program = document.Find("program");
    if (program != nullptr || document.Find("scenario") != nullptr) {
      limit = LimitOf(program == nullptr ? Program{} : ReadProgram(*program), standard.config);
    }
  } else {
    if (robot.empty()) {
      throw ConfigError(document.where +
                        ": robot: missing, and the recording does not say which it is of");
    }
    config::Layers layers{.robot = robot};
    if (!revision.empty()) layers.sets.push_back("robot.revision=" + revision);
    standard.config = config::LoadConfig(layers, config::DataDir());
  }
  standard.expect =
      ExpectationsOf(document, signals::RecordedNames(standard.config.robot, WrongField), limit);
  if (const YamlValue* stages = document.Find("stages")) standard.stages = ReadStages(*stages);
  return standard;
}

std::string ScenarioReference() {
  std::string text = "| key | takes | is |\n|---|---|---|\n";
  const auto add = [&text](const std::string& before, const ScenarioKey& row) {
    text += "| `" + before + std::string(row.key) + "` | " + std::string(row.takes) + " | " +
            std::string(row.says) + " |\n";
  };
  for (const ScenarioKey& row : kScenarioKeys) add("", row);
  for (const ScenarioKey& row : kProgramKeys) add("program.", row);
  return text + StagesReference() + VaryReference();
}

}  // namespace understudy::rehearse
