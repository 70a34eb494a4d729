#include "config/load.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
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

YamlValue* FindIn(YamlValue* map, std::string_view key) {
  for (std::size_t i = 0; i < map->keys.size(); ++i) {
    if (map->keys[i].text == key) return &map->items[i];
  }
  return nullptr;
}

// A model that lies beside the file that names it is that one, else it is below models.
YamlValue ReadLayer(const std::filesystem::path& file) {
  YamlValue tree = ReadYamlFile(file);
  YamlValue* robot = FindIn(&tree, "robot");
  YamlValue* model = robot == nullptr ? nullptr : FindIn(robot, "model");
  if (model == nullptr || model->text.empty()) return tree;
  std::error_code error;
  const std::filesystem::path beside = file.parent_path() / model->text;
  if (std::filesystem::is_regular_file(beside, error)) {
    model->text = std::filesystem::absolute(beside).lexically_normal().string();
  }
  return tree;
}

void AddTrees(const Layers& layers, std::vector<YamlValue>* trees) {
  for (const std::string& file : layers.files) trees->push_back(ReadLayer(file));
  for (const std::string& set : layers.sets) trees->push_back(SetTree(set));
}

bool IsSceneFile(const std::string& scene) {
  return scene.ends_with(".yaml") || scene.ends_with(".yml");
}

// The last word on the scene; "" where there is none. What is no text is refused when it is read.
std::string LastScene(const std::vector<YamlValue>& trees) {
  std::string scene;
  for (const YamlValue& tree : trees) {
    if (const YamlValue* value = tree.Find("scene")) scene = value->text;
  }
  return scene;
}

// A scene's own file lies below all other layers.
void ReadSceneFile(const std::string& file, Config* config, Places* places) {
  config->scene = kPatchesScene;
  const YamlValue tree = ReadYamlFile(file);
  Reader reader(tree, places);
  DescribeScene(reader, *config);
  reader.Finish();
  if (IsSceneFile(config->scene)) {
    throw ConfigError(places->at("scene") + ": scene: a scene's own file cannot name another");
  }
}

Config ReadLayers(const std::vector<YamlValue>& trees, Places* places) {
  Config config;
  const std::string last = LastScene(trees);
  if (IsSceneFile(last)) ReadSceneFile(last, &config, places);
  const std::string scene = config.scene;
  for (const YamlValue& tree : trees) {
    Reader reader(tree, places);
    Describe(reader, config);
    reader.Finish();
  }
  if (IsSceneFile(last)) config.scene = scene;
  return config;
}

// What a mapping of mappings holds at a path; null where it is not there.
const YamlValue* FindAt(const YamlValue& tree, std::initializer_list<std::string_view> path) {
  const YamlValue* value = &tree;
  for (const std::string_view key : path) {
    if (value->kind != YamlValue::Kind::kMap) return nullptr;
    value = value->Find(key);
    if (value == nullptr) return nullptr;
  }
  return value;
}

// Whether a layer over the robot's own file, which comes first, names another model and none says
// whose joint figures to use.
bool LeavesJointsToAnotherModel(const std::vector<YamlValue>& trees) {
  const YamlValue* own = FindAt(trees.front(), {"robot", "model"});
  bool another = false;
  for (std::size_t i = 1; i < trees.size(); ++i) {
    if (const YamlValue* model = FindAt(trees[i], {"robot", "model"})) {
      another = own == nullptr || model->text != own->text;
    }
    const YamlValue* dynamics = FindAt(trees[i], {"robot", "dynamics"});
    if (dynamics == nullptr) continue;
    const bool scalar = dynamics->kind == YamlValue::Kind::kScalar;
    if (scalar || dynamics->Find("use") != nullptr) return false;
  }
  return another;
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
  std::vector<YamlValue> trees{ReadLayer(RobotFile(layers.robot, data_dir))};
  AddTrees(layers, &trees);
  Places places;
  Config config = ReadLayers(trees, &places);
  if (LeavesJointsToAnotherModel(trees)) config.robot.dynamics.use = DynamicsSource::kCatalogue;
  Validate(config, places);
  return config;
}

Config LoadScene(const Layers& layers) {
  std::vector<YamlValue> trees;
  AddTrees(layers, &trees);
  Places places;
  Config config = ReadLayers(trees, &places);
  ValidateTerrain(config, places);
  return config;
}

std::string PrintConfig(const Config& config, bool with_comments) {
  Config copy = config;  // an archive may write
  Printer printer(with_comments);
  Describe(printer, copy);
  return printer.text();
}

}  // namespace understudy
