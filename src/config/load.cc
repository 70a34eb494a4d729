#include "config/load.h"

#include <algorithm>
#include <cstddef>
#include <system_error>
#include <utility>

#include "config/keys.h"
#include "config/printer.h"
#include "config/reader.h"
#include "config/validate.h"
#include "config/yaml_document.h"
#include "robot/errors.h"
#include "robot/nearest_word.h"

namespace understudy {
namespace {

std::filesystem::path RobotFile(const std::string& robot, const std::filesystem::path& data_dir) {
  if (robot.find('/') != std::string::npos || robot.ends_with(".yaml")) return robot;
  const std::vector<std::string> names = RobotNames(data_dir);
  if (std::find(names.begin(), names.end(), robot) == names.end()) {
    throw ConfigError("robot '" + OneLine(robot) + "': unknown" + DidYouMean(robot, names));
  }
  return data_dir / "config" / "robots" / (robot + ".yaml");
}

// "robot.motors.3.slot=4" as the tree {robot: {motors: {3: {slot: 4}}}}.
YamlValue SetTree(const std::string& set) {
  constexpr std::size_t kLongestKey = 200;
  const std::string where = "--set " + OneLine(set);
  const std::size_t equals = set.find('=');
  const std::string key = set.substr(0, equals);
  if (equals == std::string::npos || key.empty() || key.size() > kLongestKey ||
      key.front() == '.' || key.back() == '.' || key.find("..") != std::string::npos) {
    throw ConfigError(where + ": expected KEY=VALUE, as in gate.timeout=0.5");
  }
  YamlValue tree = ParseYaml(set.substr(equals + 1), where, /*numbered=*/false);
  for (std::size_t end = key.size(); end != std::string::npos;) {
    const std::size_t dot = key.rfind('.', end - 1);
    const std::size_t begin = dot == std::string::npos ? 0 : dot + 1;
    tree = MapOf(key.substr(begin, end - begin), std::move(tree));
    end = dot;
  }
  return tree;
}

void ReadLayer(const YamlValue& tree, Config* config, Places* places) {
  Reader reader(tree, places);
  Describe(reader, *config);
  reader.Finish();
}

}  // namespace

std::vector<std::string> RobotNames(const std::filesystem::path& data_dir) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry :
       std::filesystem::directory_iterator(data_dir / "config" / "robots", error)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Config LoadConfig(const Layers& layers, const std::filesystem::path& data_dir) {
  Config config;
  Places places;
  ReadLayer(ReadYamlFile(RobotFile(layers.robot, data_dir)), &config, &places);
  for (const std::string& file : layers.files) ReadLayer(ReadYamlFile(file), &config, &places);
  for (const std::string& set : layers.sets) ReadLayer(SetTree(set), &config, &places);
  Validate(config, places);
  return config;
}

std::string PrintConfig(const Config& config, bool with_comments) {
  Config copy = config;  // an archive may write
  Printer printer(with_comments);
  Describe(printer, copy);
  return printer.text();
}

}  // namespace understudy
