// From files and options to a Config.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/config.h"
#include "emulator/settings.h"

namespace understudy::config {

// What a run is told, weakest first; all of it over the defaults in the structs.
struct Layers {
  std::string
      robot{};  // a name in config/robots, or the path of a YAML file (has '/' or ends .yaml)
  std::vector<std::string> files{};  // --config, in order
  std::vector<std::string>
      sets{};  // --set KEY=VALUE, in order; keys dotted, list elements by index
};

// The effective configuration, validated. A robot file is a layer like the others: its `robot`
// section says what the robot is, its other keys are that robot's run defaults. It may extend
// another and have revisions (config/robot_file.h), of which the last `robot.revision` of all
// layers is laid over it, below the other layers; faults in the rest are for `understudy check` to
// find. A relative `robot.model` that is a file beside the YAML that names it becomes absolute. A
// `scene` that is a YAML file is a layer below all of them; the configuration then has the scene it
// names, or row. Throws ConfigError.
Config LoadConfig(const Layers& layers, const std::filesystem::path& data_dir);

// The same without a robot, for its `scene` and `terrain`: layers.robot is left out and only these
// two are validated. Throws ConfigError.
Config LoadScene(const Layers& layers);

// All keys and values as YAML. Given as a --config file over the same robot it yields the same
// configuration, number by number. With comments, meaning, unit and range stand above each key.
std::string PrintConfig(const Config& config, bool with_comments);

// What the emulator takes of a configuration, which has been validated.
emulator::WorldSettings WorldSettingsOf(const Config& config);
emulator::RobotSettings RobotSettingsOf(const Config& config);

}  // namespace understudy::config
