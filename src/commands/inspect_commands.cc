#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/exit_code.h"
#include "commands/commands.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "config/model_files.h"
#include "config/robot_file.h"
#include "mjcf/compile.h"
#include "physics/world_model.h"
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

// "; --revision 2, [5], 6": in brackets the one that is played unless another is asked for.
std::string Listed(const std::vector<std::string>& revisions, const std::string& own) {
  std::string text;
  for (const std::string& name : revisions) {
    text += (text.empty() ? "; --revision " : ", ") + (name == own ? "[" + name + "]" : name);
  }
  return text;
}

// Throws ModelError where the robot does not fit its model. `notes` may be null.
void CheckFits(const config::Config& config, const config::SceneFile& scene,
               physics::LoadNotes* notes) {
  const robot::RobotSpec& robot = config.robot;
  try {
    physics::LoadWorldModel({{robot, config::ModelFile(robot)}}, scene.path(),
                            config.physics.timestep, notes);
  } catch (const ModelError& error) {
    if (robot.revision.empty()) throw;
    throw ModelError("revision " + robot.revision + ": " + error.what());
  }
}

// What a sound file holds, in one line. Throws SetupError for an unsound one. Of a model, `notes`
// has what loading it brought up.
std::string CheckFile(const std::filesystem::path& file, physics::LoadNotes* notes) {
  const std::string extension = file.extension();
  if (extension == ".xml") {
    const mjcf::ModelHandle model = physics::LoadModelFile(file, notes);
    return "MJCF, " + mjcf::CountsText(*model);
  }
  if (extension != ".yaml" && extension != ".yml") {
    throw ConfigError(file.string() + ": expected a .yaml or .xml file");
  }
  if (const config::YamlValue document = config::ReadYamlFile(file); script::IsScript(document)) {
    return "script, " + std::to_string(script::ReadScript(document).size()) + " events";
  }
  const config::Config config =
      config::LoadConfig({.robot = file.string(), .files = {}, .sets = {}}, config::DataDir());
  const config::SceneFile scene("flat", {});
  CheckFits(config, scene, notes);
  for (const std::string& revision :
       config::ReadRobotFile(file.string(), config::DataDir()).RevisionNames()) {
    const std::vector<std::string> sets{"robot.revision=" + revision};
    CheckFits(
        config::LoadConfig({.robot = file.string(), .files = {}, .sets = sets}, config::DataDir()),
        scene, nullptr);
  }
  notes->looks.clear();  // of interest where one checks a model
  const std::size_t hands = config.robot.hands.size();
  return "robot " + config.robot.name + ", " + std::to_string(config.robot.motors.size()) +
         " motors, " + (hands == 0 ? "" : std::to_string(hands) + " hands, ") + "fits its model";
}

// One file's result. A refusal's text names file and line by itself; that of an included file does
// not name the one that was asked for.
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
    const robot::RobotSpec& robot = config.robot;
    const std::vector<std::string> revisions = config::ReadRobotFile(name, data).RevisionNames();
    if (as_json) {
      list.push_back({{"name", name},
                      {"description", robot.description},
                      {"motors", robot.motors.size()},
                      {"wire", Family(robot.family)},
                      {"mode_machine", robot.mode_machine},
                      {"revision", robot.revision},
                      {"revisions", revisions},
                      {"lowstate_hz", robot.rates.lowstate_hz},
                      {"start", robot.default_start}});
    } else {
      std::printf("%-14s %2zu motors  %s  %4.0f Hz  %s%s\n", name.c_str(), robot.motors.size(),
                  Family(robot.family), robot.rates.lowstate_hz, robot.description.c_str(),
                  Listed(revisions, robot.revision).c_str());
    }
  }
  if (as_json) std::printf("%s\n", list.dump(2).c_str());
  return 0;
}

int ServicesCommand() {
  const std::filesystem::path data = config::DataDir();
  std::map<std::string, std::vector<std::string>> apis;
  for (const std::string& name : config::RobotNames(data)) {
    apis[name] = config::LoadConfig({.robot = name, .files = {}, .sets = {}}, data).robot.apis;
  }
  std::fputs(services::ServicesReference(apis).c_str(), stdout);
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

// The exit code is that of the first file that cannot be used.
int CheckCommand(const std::vector<std::string>& files, bool as_json) {
  ExitCode code = ExitCode::kOk;
  json list = json::array();
  for (const std::string& file : files) {
    physics::LoadNotes notes;
    std::string text;
    bool ok = true;
    try {
      text = CheckFile(file, &notes);
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
  const auto flag = std::make_shared<bool>(false);  // of the one that was asked for
  CLI::App* robots = app->add_subcommand("robots", "List the robots that can be played");
  robots->add_flag("--json", *flag, "As a JSON array");
  robots->footer(
      "Example: understudy robots --json\n"
      "A robot of your own: understudy run my_robot.yaml, checked by understudy check.");
  robots->callback([=] { *chosen = [=] { return RobotsCommand(*flag); }; });

  const auto files = std::make_shared<std::vector<std::string>>();
  CLI::App* check =
      app->add_subcommand("check", "Check robot descriptions (.yaml) and models (.xml)");
  check->add_option("files", *files, "Files to check")->required()->type_name("FILE...");
  check->add_flag("--json", *flag, "As a JSON array");
  check->footer(
      "Example: understudy check my_robot.yaml my_robot.xml\n"
      "Exits with 3 or 4, as `run` would, when a file is unsound.");
  check->callback([=] { *chosen = [=] { return CheckCommand(*files, *flag); }; });

  CLI::App* version = app->add_subcommand("version", "Say which version this is");
  version->add_flag("--json", *flag, "As a JSON object");
  version->footer("Example: understudy version --json");
  version->callback([=] { *chosen = [=] { return VersionCommand(*flag); }; });

  CLI::App* services =
      app->add_subcommand("services", "Print what every robot's services answer, as Markdown");
  services->footer("Example: understudy services > docs/services.md");
  services->callback([=] { *chosen = ServicesCommand; });

  CLI::App* requests = app->add_subcommand(
      "requests", "Print what can be asked of a running robot, as Markdown or for OpenAPI");
  requests->add_flag("--openapi", *flag, "The paths of docs/openapi.yaml");
  requests->footer("Example: understudy requests > docs/requests.md");
  requests->callback([=] { *chosen = [=] { return RequestsCommand(*flag); }; });
}

}  // namespace understudy::commands
