#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "assembly/sight_model.h"
#include "base/errors.h"
#include "base/exit_code.h"
#include "commands/commands.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "config/model_files.h"
#include "config/robot_file.h"
#include "mjcf/compile.h"
#include "physics/world_model.h"
#include "rehearse/scenario.h"
#include "robot/fault_docs.h"
#include "script/script.h"
#include "server/request_docs.h"
#include "services/robot_services.h"
#include "version.h"

namespace understudy::commands {
namespace {

using nlohmann::json;

const char* Family(robot::WireFamily family) {
  return family == robot::WireFamily::kGo ? "go" : "hg";
}

const char* Kind(robot::RobotKind kind) {
  switch (kind) {
    case robot::RobotKind::kQuadruped:
      return "quadruped";
    case robot::RobotKind::kWheeled:
      return "wheeled";
    case robot::RobotKind::kHumanoid:
      return "humanoid";
    case robot::RobotKind::kOther:
      break;
  }
  return "other";
}

// Formats "; --revision 2, [5], 6" with `own` in brackets, "" without names.
std::string Listed(const std::string& what, const std::vector<std::string>& names,
                   const std::string& own) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "; " + what + " " : ", ") + (name == own ? "[" + name + "]" : name);
  }
  return text;
}

// Throws ModelError if a robot does not fit its model. `notes` may be null.
void CheckFits(const config::Config& config, const config::SceneFile& scene,
               physics::LoadNotes* notes) {
  try {
    physics::LoadWorldModel(assembly::PlacedRobots(config), {scene.path(), config.objects},
                            config.physics.timestep, notes);
  } catch (const ModelError& error) {
    const std::string& revision = config.robots[0].spec.revision;
    if (revision.empty() || config.robots.size() > 1) throw;
    throw ModelError("revision " + revision + ": " + error.what());
  }
}

// Whether a YAML file describes a robot; else it is a layer over one, for --config or --scene.
bool IsRobot(const schema::YamlValue& document) {
  const schema::YamlValue* robot = document.Find("robot");
  return document.Find("extends") != nullptr ||
         (robot != nullptr && robot->kind == schema::YamlValue::Kind::kMap &&
          robot->Find("name") != nullptr);
}

// Throws ConfigError with the robots there are if --robot was not given; `what` needs one.
void RequireRobot(const std::string& robot, const std::string& what) {
  if (!robot.empty()) return;
  std::string names;
  for (const std::string& name : config::RobotNames(config::DataDir())) {
    names += (names.empty() ? "" : ", ") + name;
  }
  throw ConfigError(what + "; name one with --robot: " + names + ", or its file");
}

// Whether a file says nothing but the ground, and all of it: patches, or a scene of a name. One
// that only changes the ground, or only lays objects on it, is a layer.
bool IsScene(const schema::YamlValue& document) {
  constexpr std::array kOfScenes = {"scene", "terrain", "objects"};
  const auto is_of_scenes = [&](const auto& key) {
    return std::ranges::find(kOfScenes, key.text) != kOfScenes.end();
  };
  if (!std::ranges::all_of(document.keys, is_of_scenes)) return false;
  const schema::YamlValue* terrain = document.Find("terrain");
  const bool has_patches = terrain != nullptr && terrain->kind == schema::YamlValue::Kind::kMap &&
                           terrain->Find("patches") != nullptr;
  return has_patches || document.Find("scene") != nullptr;
}

// Checks a layer over `robot` as `run` reads it: as --scene if it is one.
std::string CheckLayer(const std::filesystem::path& file, const schema::YamlValue& document,
                       const std::string& robot) {
  RequireRobot(robot, file.string() +
                          ": is a layer (neither robot.name nor extends); check it with a robot");
  const bool is_scene = IsScene(document);
  config::Layers layers{.robot = robot};
  if (is_scene) {
    layers.sets.push_back("scene=" + std::filesystem::absolute(file).string());
  } else {
    layers.files.push_back(file.string());
  }
  const config::Config config = config::LoadConfig(layers, config::DataDir());
  CheckFits(config, config::SceneFile(config.scene, config.terrain), nullptr);
  return (is_scene ? "scene for --scene, fits " : "layer for --config, fits ") + robot;
}

std::string NamesOf(const config::Config& config) {
  std::string text;
  for (const config::RobotConfig& one : config.robots) text += (text.empty() ? "" : " ") + one.name;
  return text;
}

// Checks a file of several robots, as `run` reads it.
std::string CheckWorld(const std::filesystem::path& file, physics::LoadNotes* notes) {
  const config::Config config =
      config::LoadConfig({.robot = std::filesystem::absolute(file).string()}, config::DataDir());
  CheckFits(config, config::SceneFile(config.scene, config.terrain), notes);
  return "world of " + NamesOf(config);
}

std::string Counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

// Checks a scenario, or a file of nothing but expectations, of `robot` unless it names its own.
std::string CheckScenario(const std::filesystem::path& file, const schema::YamlValue& document,
                          const std::string& robot) {
  const auto count = [](const rehearse::Expectations& expect) {
    return Counted(expect.list.size(), "expectation");
  };
  // Keys that say how something is played: the title may be what was forgotten.
  constexpr std::array kPlayed = {"scenario", "start",  "duration", "program",
                                  "script",   "stages", "vary"};
  const bool is_played =
      std::ranges::any_of(kPlayed, [&](const char* key) { return document.Find(key) != nullptr; });
  if (!is_played) {
    const bool names_robot =
        document.Find("robot") != nullptr || document.Find("robots") != nullptr;
    if (!names_robot) RequireRobot(robot, file.string() + ": robot: missing");
    return count(rehearse::LoadStandard(file, names_robot ? "" : robot, {}).expect);
  }
  const rehearse::Scenario scenario = rehearse::LoadScenario(file);
  CheckFits(scenario.config, config::SceneFile(scenario.config.scene, scenario.config.terrain),
            nullptr);
  std::string text = "scenario for " + NamesOf(scenario.config) + ", " +
                     Counted(scenario.script.events.size(), "event") + ", " +
                     count(scenario.expect);
  if (scenario.plan) {
    rehearse::CheckRuns(file, *scenario.plan, {});
    text += ", campaign of " + Counted(scenario.plan->size(), "run") + " over";
    for (const rehearse::Axis& axis : scenario.plan->axes()) text += " " + axis.key;
  }
  return text;
}

// Returns one line about a valid file. Throws SetupError for an invalid one. For a model, sets
// `notes` to those of loading it. A layer is checked over `robot`.
std::string CheckFile(const std::filesystem::path& file, const std::string& robot,
                      physics::LoadNotes* notes) {
  const std::string extension = file.extension();
  if (extension == ".xml") {
    const mjcf::ModelHandle model = physics::LoadModelFile(file, notes);
    return "MJCF, " + mjcf::CountsText(*model);
  }
  if (extension != ".yaml" && extension != ".yml") {
    throw ConfigError(file.string() + ": expected a .yaml or .xml file");
  }
  const schema::YamlValue document = schema::ReadYamlFile(file);
  if (rehearse::IsScenario(document)) return CheckScenario(file, document, robot);
  if (script::IsScript(document)) {
    const script::Script script = script::ReadScript(document, signals::RunningNames());
    return "script, " + Counted(script.events.size(), "event");
  }
  if (document.Find("robots") != nullptr) return CheckWorld(file, notes);
  if (!IsRobot(document)) return CheckLayer(file, document, robot);
  const config::Config config =
      config::LoadConfig({.robot = file.string(), .files = {}, .sets = {}}, config::DataDir());
  const config::SceneFile scene("flat", {});
  CheckFits(config, scene, notes);
  const config::RobotFile variants = config::ReadRobotFile(file.string(), config::DataDir());
  const auto check = [&](const std::string& key, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const std::vector<std::string> sets{"robot." + key + "='" + name + "'"};
      CheckFits(config::LoadConfig({.robot = file.string(), .files = {}, .sets = sets},
                                   config::DataDir()),
                scene, nullptr);
    }
  };
  check("revision", variants.RevisionNames());
  check("firmware", variants.FirmwareNames());
  check("hand_make", config.robots[0].spec.hand_makes);
  notes->looks.clear();  // only for the check of a model
  const std::size_t hands = config.robots[0].spec.hands.size();
  return "robot " + config.robots[0].spec.name + ", " +
         std::to_string(config.robots[0].spec.motors.size()) + " motors, " +
         (hands == 0 ? "" : std::to_string(hands) + " hands, ") + "fits its model";
}

// Makes the JSON result of one file. The text of an error has its own file and line, which may be
// those of an included file.
json Entry(const std::string& file, const std::string& text, bool ok,
           const physics::LoadNotes& notes) {
  json entry = {{"file", file}, {"ok", ok}, {"text", text}};
  entry["rewrites"] = json::array();
  for (const mjcf::Rewrite& rewrite : notes.rewrites) {
    entry["rewrites"].push_back({{"file", rewrite.place.file},
                                 {"line", rewrite.place.line},
                                 {"what", rewrite.what},
                                 {"why", rewrite.why}});
  }
  entry["notes"] = notes.warnings;
  for (const std::string& looks : notes.looks) entry["notes"].push_back(looks);
  entry["unknown"] = notes.unknown;
  return entry;
}

void Print(const std::string& file, const std::string& text, bool ok,
           const physics::LoadNotes& notes) {
  const bool names_file = !ok && text.starts_with(file);
  std::string line = (ok ? "ok   " : "FAIL ") + (names_file ? "" : file + ": ") + text;
  if (!notes.rewrites.empty()) {
    line += "; " + std::to_string(notes.rewrites.size()) + " places rewritten for MuJoCo " +
            mjcf::MujocoVersion();
  }
  std::printf("%s\n", line.c_str());
  for (const mjcf::Rewrite& rewrite : notes.rewrites)
    std::printf("     %s\n", rewrite.text().c_str());
  for (const std::string& note : notes.warnings) std::printf("     %s\n", note.c_str());
  for (const std::string& looks : notes.looks) std::printf("     %s\n", looks.c_str());
  for (const std::string& unknown : notes.unknown) {
    if (unknown != text) std::printf("     %s\n", unknown.c_str());
  }
}

ExitCode CodeOf(const SetupError& error) {
  return dynamic_cast<const ModelError*>(&error) != nullptr ? ExitCode::kModel : ExitCode::kConfig;
}

int RobotsCommand(bool as_json) {
  const std::filesystem::path data = config::DataDir();
  json list = json::array();
  for (const std::string& name : config::RobotNames(data)) {
    const config::Config config =
        config::LoadConfig({.robot = name, .files = {}, .sets = {}}, data);
    const robot::RobotSpec& robot = config.robots[0].spec;
    const config::RobotFile file = config::ReadRobotFile(name, data);
    const std::vector<std::string> revisions = file.RevisionNames();
    const std::vector<std::string> firmwares = file.FirmwareNames();
    const config::RobotVariant* firmware = file.FindFirmware(robot.firmware);
    std::vector<std::string> cameras;
    for (const robot::CameraSpec& camera : robot.cameras) cameras.push_back(camera.name);
    if (as_json) {
      list.push_back({{"name", name},
                      {"description", robot.description},
                      {"motors", robot.motors.size()},
                      {"wire", Family(robot.family)},
                      {"kind", Kind(robot.kind)},
                      {"apis", robot.apis},
                      {"cameras", cameras},
                      {"mode_machine", robot.mode_machine},
                      {"revision", robot.revision},
                      {"revisions", revisions},
                      {"firmware", robot.firmware},
                      {"firmwares", firmwares},
                      {"hands", robot.hand_make},
                      {"hand_makes", robot.hand_makes},
                      {"lowstate_hz", robot.rates.lowstate_hz},
                      {"start", robot.default_start}});
    } else {
      std::printf("%-14s %2zu motors  %s  %4.0f Hz  %s%s\n", name.c_str(), robot.motors.size(),
                  Family(robot.family), robot.rates.lowstate_hz, robot.description.c_str(),
                  (Listed("--revision", revisions, robot.revision) +
                   Listed("--hands", robot.hand_makes, robot.hand_make) +
                   Listed("firmware from", firmwares, firmware == nullptr ? "" : firmware->name))
                      .c_str());
    }
  }
  if (as_json) std::printf("%s\n", list.dump(2).c_str());
  return 0;
}

int ServicesCommand() {
  std::fputs(services::ServicesReference().c_str(), stdout);
  return 0;
}

int FaultsCommand() {
  std::fputs(robot::FaultsReference().c_str(), stdout);
  return 0;
}

int VersionCommand(bool as_json) {
  if (as_json) {
    const json object = {{"understudy", kVersion}, {"mujoco", mjcf::MujocoVersion()}};
    std::printf("%s\n", object.dump().c_str());
  } else {
    std::printf("understudy %s (MuJoCo %s)\n", kVersion, mjcf::MujocoVersion());
  }
  return 0;
}

// Returns the exit code of the first invalid file.
int CheckCommand(const std::vector<std::string>& files, const std::string& robot, bool as_json) {
  ExitCode code = ExitCode::kOk;
  json list = json::array();
  for (const std::string& file : files) {
    physics::LoadNotes notes;
    std::string text;
    bool ok = true;
    try {
      text = CheckFile(file, robot, &notes);
    } catch (const SetupError& error) {
      ok = false;
      text = error.what();
      if (code == ExitCode::kOk) code = CodeOf(error);
    }
    if (as_json) {
      list.push_back(Entry(file, text, ok, notes));
    } else {
      Print(file, text, ok, notes);
    }
  }
  if (as_json) std::printf("%s\n", list.dump(2).c_str());
  return static_cast<int>(code);
}

int RequestsCommand(bool openapi) {
  const std::string text = openapi ? server::RequestsOpenApi() : server::RequestsReference();
  std::fputs(text.c_str(), stdout);
  return 0;
}

}  // namespace

void AddInspectCommands(CLI::App* app, Chosen* chosen) {
  const auto flag = std::make_shared<bool>(false);  // --json or --openapi of the chosen subcommand
  CLI::App* robots = app->add_subcommand("robots", "List the robots that can be simulated");
  robots->add_flag("--json", *flag, "As a JSON array");
  robots->footer(
      "Example: understudy robots --json\n"
      "A robot of your own: understudy run my_robot.yaml; understudy check checks its file.");
  robots->callback([=] { *chosen = [=] { return RobotsCommand(*flag); }; });

  const auto files = std::make_shared<std::vector<std::string>>();
  CLI::App* check = app->add_subcommand(
      "check", "Check files: robots, layers, scenes, scripts, scenarios (.yaml) and models (.xml)");
  check->add_option("files", *files, "Files to check")->required()->type_name("FILE...");
  const auto robot = std::make_shared<std::string>();
  check->add_option("--robot", *robot,
                    "Robot for files that name none: those for --config, --scene and judge");
  check->add_flag("--json", *flag, "As a JSON array");
  check->footer(
      "Examples:\n"
      "  understudy check my_robot.yaml my_robot.xml\n"
      "  understudy check --robot g1 course.yaml randomization.yaml\n"
      "Exits with 3 or 4, as `run` does, if a file is invalid.");
  check->callback([=] { *chosen = [=] { return CheckCommand(*files, *robot, *flag); }; });

  CLI::App* version = app->add_subcommand("version", "Print the version");
  version->add_flag("--json", *flag, "As a JSON object");
  version->footer("Example: understudy version --json");
  version->callback([=] { *chosen = [=] { return VersionCommand(*flag); }; });

  // These write pages of docs/reference: for who changes Understudy, so help does not list them.
  constexpr const char* kHidden = "";
  CLI::App* services =
      app->add_subcommand("services", "Print the apis of all services as Markdown");
  services->group(kHidden);
  services->footer("Example: understudy services > docs/reference/services.md");
  services->callback([=] { *chosen = ServicesCommand; });

  CLI::App* faults = app->add_subcommand("faults", "Print all faults of components as Markdown");
  faults->group(kHidden);
  faults->footer("Example: understudy faults > docs/reference/faults.md");
  faults->callback([=] { *chosen = FaultsCommand; });

  CLI::App* requests = app->add_subcommand(
      "requests", "Print all requests to a running robot as Markdown or for OpenAPI");
  requests->group(kHidden);
  requests->add_flag("--openapi", *flag, "Print the paths of openapi.yaml");
  requests->footer("Example: understudy requests > docs/reference/requests.md");
  requests->callback([=] { *chosen = [=] { return RequestsCommand(*flag); }; });
}

}  // namespace understudy::commands
