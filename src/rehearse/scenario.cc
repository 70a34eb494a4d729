#include "rehearse/scenario.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <system_error>
#include <utility>

#include "base/errors.h"
#include "config/data_dir.h"
#include "objects/object_kinds.h"
#include "rehearse/evidence.h"
#include "rehearse/with_settings.h"
#include "rehearse/yaml_values.h"

namespace understudy::rehearse {
namespace {

using schema::YamlValue;
using Kind = YamlValue::Kind;

// Letters; *assumed*.
constexpr std::size_t kMostTitle = 80;
constexpr std::size_t kMostText = 400;

using schema::Field;
using schema::kTree;

// A key of a scenario. `sets` is the key of the configuration for which it stands, "" for others.
struct ScenarioKey {
  std::string_view key, takes, does, sets{};
};
constexpr ScenarioKey kScenarioKeys[] = {
    {"scenario", "a text", "Its title; needed"},
    {"about", "a sentence", "What it shows"},
    {"robot", "a robot's name or YAML file",
     "Needed, unless there are `robots`; a file is looked for beside the scenario first"},
    {"robots", "a mapping",
     "[Several robots](several.md) in one world, as in a file of robots; each expectation then "
     "names the robot of a signal, as `left:base.tilt < 30 deg`"},
    {"revision", "a revision's name",
     "Of the robot's hardware, as `understudy robots` lists them; the robot's default unless "
     "given",
     "robot.revision"},
    {"start", "lying, standing, hanging, clamped", "Start pose; the robot's default unless given",
     "start.pose"},
    {"seed", "a whole number", "Of randomization: randomization.seed", "randomization.seed"},
    {"profile", "ideal, nominal, worn, harsh",
     "How good the [sensors](sensors.md) are; nominal unless given", "profile"},
    {"faults", "a list", "What [fails](faults.md) from the start, or planned with `at`", "faults"},
    {"scene", "a kind of terrain or a file",
     "Ground; a file is looked for beside the scenario first"},
    {"objects", "a list", "[Things in the scene](objects.md)", "objects"},
    {"clock", "real, simulated",
     "Of robot and program: the computer's, or one that [waits for the program](../clock.md); "
     "real unless given"},
    {"speed", "a number, or max",
     "Simulated seconds per wall second: max, or 1 with a program on the real clock, unless given"},
    {"duration", "seconds", "After which the rehearsal ends; needed without a program",
     "time.duration"},
    {"settings", "a mapping", "Further keys of the configuration, as in a file for --config"},
    {"program", "a mapping", "The program under test, see below"},
    {"script", "a list",
     "What happens when, as in a [script](scripts.md); a refused event fails the rehearsal, "
     "[unless "
     "it is expected](../rehearsing.md#a-program-under-test)"},
    {"expect", "a list",
     "Expectations, see below; needed. `safe` among them is the [standard "
     "set](../rehearsing.md#the-standard-set)"},
    {"stages", "a list",
     "The [ladder](../rehearsing.md#stages) to a real robot, each stage with its limits"},
    {"vary", "a mapping", "How the runs of a [campaign](../rehearsing.md#campaigns) differ"},
};

std::vector<Field> ScenarioFields() {
  std::vector<Field> fields;
  for (const auto& [key, takes, does, sets] : kScenarioKeys) {
    fields.push_back({.key = key, .type = &kTree, .does = does, .takes = takes});
  }
  return fields;
}

const YamlValue& Needed(const YamlValue& map, const std::string& key) {
  const YamlValue* value = map.Find(key);
  if (value == nullptr) throw ConfigError(map.where + ": " + key + ": missing");
  return *value;
}

// The value under a dotted key of the configuration.
YamlValue TreeOf(std::string_view key, YamlValue value) {
  const std::size_t dot = key.find('.');
  if (dot != std::string_view::npos) value = TreeOf(key.substr(dot + 1), std::move(value));
  return schema::MapOf(std::string(key.substr(0, dot)), std::move(value));
}

YamlValue ScalarOf(std::string text, const std::string& where) {
  YamlValue value;
  value.kind = Kind::kScalar;
  value.text = std::move(text);
  value.where = where;
  return value;
}

// A file beside the scenario comes before one that the working folder has.
std::string Beside(const std::filesystem::path& file, const std::string& name) {
  std::error_code error;
  const std::filesystem::path beside = file.parent_path() / name;
  if (!std::filesystem::is_regular_file(beside, error)) return name;
  return std::filesystem::absolute(beside);
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
    YamlValue ends = schema::MapOf("eventually", ScalarOf("program_end happens", where));
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
  Expectations expect = ReadExpectations(list, names);
  expect.script = document.Find("script") != nullptr &&
                  std::ranges::none_of(expect.signals, [](const Signal& signal) {
                    return signal.topic == "script_refused" || signal.topic == "script_wait";
                  });
  return expect;
}

bool IsClockSimulated(const YamlValue& document, const ScenarioOptions& options) {
  const YamlValue* clock = document.Find("clock");
  if (clock == nullptr) return options.simulated_clock;
  if (clock->text != "real" && clock->text != "simulated") {
    Refuse(*clock, "clock", "real or simulated");
  }
  return options.simulated_clock || clock->text == "simulated";
}

// The configuration that a scenario describes; `run` as Scenario has it.
config::Config ConfigOf(const YamlValue& document, const std::filesystem::path& file,
                        const ScenarioOptions& options, bool has_program, std::size_t run) {
  const YamlValue* robots = document.Find("robots");
  if (robots != nullptr && document.Find("robot") != nullptr) {
    throw ConfigError(robots->where + ": robots: not beside robot");
  }
  config::Layers layers{.sets = options.sets, .typed = options.typed};
  if (robots == nullptr) {
    layers.robot = LineOf(Needed(document, "robot"), "robot", kMostText);
    if (layers.robot.ends_with(".yaml")) layers.robot = Beside(file, layers.robot);
  }
  const std::string& where = document.where;
  if (run > 0) {
    layers.trees.push_back(TreeOf("randomization.seed", ScalarOf(std::to_string(run), where)));
  }
  const YamlValue* speed = document.Find("speed");
  const bool waits = has_program && !IsClockSimulated(document, options);
  const YamlValue pace = speed != nullptr ? *speed : ScalarOf(waits ? "1" : "max", where);
  layers.trees.push_back(
      TreeOf("time.speed", pace.text == "max" ? ScalarOf("0", pace.where) : pace));
  if (const YamlValue* settings = document.Find("settings")) {
    if (settings->kind != Kind::kMap) Refuse(*settings, "settings", "a mapping of keys");
    layers.trees.push_back(*settings);
  }
  for (const ScenarioKey& row : kScenarioKeys) {
    const YamlValue* value = row.sets.empty() ? nullptr : document.Find(row.key);
    if (value != nullptr) layers.trees.push_back(TreeOf(row.sets, *value));
  }
  if (const YamlValue* scene = document.Find("scene")) {
    YamlValue found = *scene;
    if (found.kind == Kind::kScalar) found.text = Beside(file, found.text);
    layers.trees.push_back(TreeOf("scene", found));
  }
  if (robots != nullptr) layers.trees.push_back(schema::MapOf("robots", *robots));
  return config::LoadConfig(layers, config::DataDir());
}

// Of the robots of a world.
template <class Of>
Names NamesOf(const config::Config& config, bool program, const Of& of) {
  std::vector<Names> names;
  for (const config::RobotConfig& robot : config.robots) {
    Names& one = names.emplace_back(of(robot.spec));
    one.robot = robot.name;
    one.program = program;
    one.objects = objects::MovingNamesOf(config.objects);
  }
  return signals::Joined(std::move(names));
}

// Of their recordings.
Names RecordedNamesOf(const config::Config& config, bool program) {
  Names names = NamesOf(config, program, [](const robot::RobotSpec& spec) {
    return signals::RecordedNames(spec, WrongField);
  });
  names.of_none = !names.robot.empty();
  return names;
}

// A ladder leads to one real robot.
std::vector<StageSpec> StagesOf(const YamlValue& document, const config::Config& config) {
  const YamlValue* stages = document.Find("stages");
  if (stages == nullptr) return {};
  if (config.robots.size() > 1) {
    throw ConfigError(stages->where + ": stages: only in a scenario of one robot");
  }
  return ReadStages(*stages);
}

YamlValue ReadDocument(const std::filesystem::path& file) {
  YamlValue document = schema::ReadYamlFile(file);
  const std::string script = ": this is a script: understudy run ROBOT --script " + file.string();
  if (document.kind == Kind::kSequence) throw ConfigError(document.where + script);
  if (document.kind != Kind::kMap) {
    throw ConfigError(document.where + ": expected a scenario: a mapping with the key expect");
  }
  const schema::Mapping keys(document, ScenarioFields());  // throws for one that is unknown
  if (document.keys.size() == 1 && document.keys[0].text == "script") {
    throw ConfigError(document.where + script);
  }
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
      const std::string start = "--set " + schema::OneLine(key + "=" + text) + ": ";
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
  scenario.simulated_clock =
      IsClockSimulated(document, chosen.options) && scenario.program.has_value();
  if (scenario.program && scenario.program->think > 0 && !scenario.simulated_clock) {
    throw ConfigError(document.Find("program")->where + ": program.think: needs clock: simulated");
  }
  scenario.config = ConfigOf(chosen, file, scenario.program.has_value());
  if (!scenario.program && scenario.config.time.duration <= 0) {
    throw ConfigError(document.where +
                      ": duration: missing; expected seconds, as no program ends the rehearsal");
  }
  if (const YamlValue* script = document.Find("script")) {
    scenario.script = script::ReadEvents(
        *script, NamesOf(scenario.config, scenario.program.has_value(),
                         [](const robot::RobotSpec& spec) { return signals::RunningNames(spec); }));
  }
  if (scenario.program) scenario.program->limit = LimitOf(*scenario.program, scenario.config);
  scenario.expect =
      ExpectationsOf(document, RecordedNamesOf(scenario.config, scenario.program.has_value()),
                     scenario.program ? scenario.program->limit : std::nullopt);
  scenario.stages = StagesOf(document, scenario.config);
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
  return Plan(Needed(schema::ParseYaml(text, name), "vary"));
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
  if (document.Find("robot") != nullptr || document.Find("robots") != nullptr) {
    standard.config = ConfigOf(chosen, file, true);
    // A scenario without a duration was played with a program.
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
  standard.expect = ExpectationsOf(document, RecordedNamesOf(standard.config, true), limit);
  standard.stages = StagesOf(document, standard.config);
  return standard;
}

std::string ScenarioReference() {
  return "| key | takes | is |\n|---|---|---|\n" + schema::MarkdownRows(ScenarioFields()) +
         ProgramReference() + StagesReference() + VaryReference();
}

}  // namespace understudy::rehearse
