#include "commands/inspect_commands.h"

#include <cstdio>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "config/data_dir.h"
#include "config/load.h"
#include "config/script.h"
#include "exit_code.h"
#include "physics/world_model.h"
#include "robot/errors.h"
#include "scene.h"
#include "version.h"

namespace understudy {
namespace {

using nlohmann::json;

const char* Family(WireFamily family) { return family == WireFamily::kGo ? "go" : "hg"; }

// What a sound file holds, in one line. Throws SetupError for an unsound one.
std::string CheckFile(const std::filesystem::path& file) {
  const std::string extension = file.extension();
  if (extension == ".xml") {
    const ModelHandle model = LoadModelFile(file);
    return "MJCF, " + std::to_string(model->nbody - 1) + " bodies, " + std::to_string(model->njnt) +
           " joints, " + std::to_string(model->nu) + " actuators";
  }
  if (extension != ".yaml" && extension != ".yml") {
    throw ConfigError(file.string() + ": expected a .yaml or .xml file");
  }
  if (const YamlValue document = ReadYamlFile(file); IsScript(document)) {
    return "script, " + std::to_string(ReadScript(document).size()) + " events";
  }
  const Config config = LoadConfig({.robot = file.string(), .files = {}, .sets = {}}, DataDir());
  const SceneFile scene("flat", {});
  const ModelHandle model =
      LoadWorldModel(config.robot, ModelFile(config.robot), scene.path(), config.physics.timestep);
  return "robot " + config.robot.name + ", " + std::to_string(config.robot.motors.size()) +
         " motors, fits its model";
}

ExitCode CodeOf(const SetupError& error) {
  return dynamic_cast<const ModelError*>(&error) != nullptr ? ExitCode::kModel : ExitCode::kConfig;
}

}  // namespace

int RobotsCommand(bool as_json) {
  const std::filesystem::path data = DataDir();
  json list = json::array();
  for (const std::string& name : RobotNames(data)) {
    const Config config = LoadConfig({.robot = name, .files = {}, .sets = {}}, data);
    const RobotSpec& robot = config.robot;
    if (as_json) {
      list.push_back({{"name", name},
                      {"description", robot.description},
                      {"motors", robot.motors.size()},
                      {"wire", Family(robot.family)},
                      {"mode_machine", robot.mode_machine},
                      {"lowstate_hz", robot.rates.lowstate_hz},
                      {"start", robot.default_start}});
    } else {
      std::printf("%-14s %2zu motors  %s  %4.0f Hz  %s\n", name.c_str(), robot.motors.size(),
                  Family(robot.family), robot.rates.lowstate_hz, robot.description.c_str());
    }
  }
  if (as_json) std::printf("%s\n", list.dump(2).c_str());
  return 0;
}

int VersionCommand(bool as_json) {
  if (as_json) {
    const json object = {{"understudy", kVersion}, {"mujoco", mj_versionString()}};
    std::printf("%s\n", object.dump().c_str());
  } else {
    std::printf("understudy %s (MuJoCo %s)\n", kVersion, mj_versionString());
  }
  return 0;
}

int CheckCommand(const std::vector<std::string>& files, bool as_json) {
  ExitCode code = ExitCode::kOk;
  json list = json::array();
  for (const std::string& file : files) {
    json entry = {{"file", file}};
    try {
      entry["ok"] = true;
      entry["text"] = CheckFile(file);
    } catch (const SetupError& error) {
      entry["ok"] = false;
      entry["text"] = error.what();
      if (code == ExitCode::kOk) code = CodeOf(error);
    }
    if (!as_json) {
      const bool ok = entry["ok"].get<bool>();
      std::printf("%s %s%s\n", ok ? "ok  " : "FAIL", ok ? (file + ": ").c_str() : "",
                  entry["text"].get<std::string>().c_str());
    }
    list.push_back(std::move(entry));
  }
  if (as_json) std::printf("%s\n", list.dump(2).c_str());
  return static_cast<int>(code);
}

}  // namespace understudy
