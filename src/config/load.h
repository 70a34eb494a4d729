// Makes a Config of files and command-line options.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/robot_file.h"
#include "emulator/settings.h"
#include "schema/yaml_document.h"

namespace understudy::config {

// The inputs of a configuration, weakest first. Keys that none of them has keep their defaults.
struct Layers {
  // A name in config/robots, or the path of a YAML file (has '/' or ends .yaml). "" if the other
  // layers name the robots.
  std::string robot{};
  std::vector<std::string> others{};  // the further robots of its world, named in the same way
  std::vector<std::string> files{};   // --config, in order
  std::vector<YamlValue> trees{};     // the same, already parsed: the settings of a scenario
  std::vector<std::string>
      sets{};  // --set KEY=VALUE, in order; keys dotted, list elements by index
  // What of these was typed otherwise, for messages: "start.pose=lying" as "--start lying".
  std::map<std::string, std::string> typed{};
};

// Returns the effective, validated configuration, of several robots as SplitByRobot has it. Layers
// are read in order, later ones override. First comes `scene` if it is a YAML file; the result then
// has the scene that this file names, or "row". Then come the robot's file, its revision, its hands
// (config/hand_choice.h), the profile (config/profile.h), --config, parsed trees and --set. The
// robot's file has a `robot` section and may have run defaults; it may extend another and have
// revisions (config/robot_file.h). The last `robot.revision` of all layers selects the revision;
// the others are not validated (`understudy check` does that). The relative path of a model or
// policy beside the YAML file that names it becomes absolute. Throws ConfigError.
Config LoadConfig(const Layers& layers, const std::filesystem::path& data_dir);

// The same with a robot's file that was read before; ignores layers.robot.
Config LoadConfig(const RobotFile& file, const Layers& layers,
                  const std::filesystem::path& data_dir);

// The same without a robot: ignores layers.robot and validates only `scene` and `terrain`. Throws
// ConfigError.
Config LoadScene(const Layers& layers);

// Returns all keys and values as YAML. As a --config file for the same robot it gives exactly the
// same configuration. `with_comments` adds meaning, unit and range above each key.
std::string PrintConfig(const Config& config, bool with_comments);

// Returns the pose in which a run starts: start.pose, else robot.default_start, but lying for a
// quadruped that would stand while no motion service holds it up.
std::string StartPoseOf(const RobotConfig& config);

// Return the emulator's part of a validated configuration.
emulator::WorldSettings WorldSettingsOf(const Config& config);
emulator::RobotSettings RobotSettingsOf(const RobotConfig& config);
// Set the keys that can change while a robot runs (emulator::LiveSettings) to their values now.
void TakeSettings(const emulator::WorldSettings& settings, Config* config);
void TakeSettings(const emulator::RobotSettings& settings, RobotConfig* config);

}  // namespace understudy::config
