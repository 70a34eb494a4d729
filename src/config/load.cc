#include "config/load.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <set>
#include <utility>

#include "authority/onboard.h"
#include "base/errors.h"
#include "base/nearest_word.h"
#include "config/hand_choice.h"
#include "config/keys.h"
#include "config/profile.h"
#include "config/reference.h"
#include "config/robot_file.h"
#include "config/robots.h"
#include "config/strew.h"
#include "config/validate.h"
#include "robot/drop_motor.h"
#include "robot/firmware.h"
#include "schema/printer.h"
#include "schema/yaml_document.h"
#include "schema/yaml_reader.h"

namespace understudy::config {
namespace {

using schema::MapOf;
using schema::OneLine;
using schema::ParseYaml;
using schema::Printer;
using schema::ReadYamlFile;
using schema::YamlReader;

// "robot.motors.3.slot=4" as the tree {robot: {motors: {3: {slot: 4}}}}. `where` is what its user
// typed.
YamlValue SetTree(const std::string& set, const std::string& where) {
  constexpr std::size_t kLongestKey = 200;
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

void AddTrees(const Layers& layers, std::vector<YamlValue>* trees) {
  for (const std::string& file : layers.files) trees->push_back(ReadLayer(file));
  trees->insert(trees->end(), layers.trees.begin(), layers.trees.end());
  for (const std::string& set : layers.sets) {
    const auto typed = layers.typed.find(set);
    trees->push_back(SetTree(
        set, typed == layers.typed.end() ? "--set " + OneLine(set) : OneLine(typed->second)));
  }
}

bool IsSceneFile(const std::string& scene) {
  return scene.ends_with(".yaml") || scene.ends_with(".yml");
}

// The scene of the last layer that has one, else "". A scene that is not text is refused later,
// when it is read.
std::string LastScene(const std::vector<YamlValue>& trees) {
  std::string scene;
  for (const YamlValue& tree : trees) {
    if (const YamlValue* value = tree.Find("scene")) scene = value->text;
  }
  return scene;
}

// Adds the scene's YAML file below all other layers.
void ReadSceneFile(const std::string& file, Config* config, Places* places) {
  config->scene = terrain::kPatchesScene;
  const YamlValue tree = ReadYamlFile(file);
  YamlReader reader(tree, places);
  DescribeScene(reader, *config);
  reader.Finish();
  if (IsSceneFile(config->scene)) {
    throw ConfigError(places->at("scene") + ": scene: a scene's own file cannot name another");
  }
}

// Removes the motors of locked joints and adds their names to `left_out`.
void LeaveOutLocked(robot::RobotSpec* robot, std::set<std::string>* left_out) {
  for (const std::string& joint : robot->locked_joints) {
    const auto motor = std::find_if(robot->motors.begin(), robot->motors.end(),
                                    [&](const robot::MotorSpec& m) { return m.joint == joint; });
    if (motor == robot->motors.end()) continue;
    left_out->insert(joint);
    robot::DropMotor(static_cast<std::size_t>(motor - robot->motors.begin()), robot);
  }
}

// Gives motors the limits of their types where they have none of their own.
void TakeLimitsOfTypes(robot::RobotSpec* robot) {
  for (robot::MotorSpec* motor : robot::AllMotors(*robot)) {
    const robot::MotorTypeSpec* type = robot::FindMotorType(*robot, motor->type);
    if (type == nullptr) continue;
    if (motor->torque_limit == 0) motor->torque_limit = type->torque_limit * motor->gear;
    if (motor->knee_speed == 0) motor->knee_speed = type->knee_speed / motor->gear;
    if (motor->no_load_speed == 0) motor->no_load_speed = type->no_load_speed / motor->gear;
  }
}

void CheckLocked(const robot::RobotSpec& robot, const std::set<std::string>& left_out,
                 const Places& places) {
  std::vector<std::string> joints(left_out.begin(), left_out.end());
  for (const robot::MotorSpec& motor : robot.motors) joints.push_back(motor.joint);
  for (const std::string& joint : robot.locked_joints) {
    if (left_out.contains(joint)) continue;
    throw ConfigError(places.at("robot.locked_joints") +
                      ": robot.locked_joints: no motor has a joint '" + OneLine(joint) + "'" +
                      DidYouMean(joint, joints));
  }
}

Config ReadLayers(const std::vector<YamlValue>& trees, Places* places) {
  Config config;
  std::set<std::string> left_out;
  const std::string last = LastScene(trees);
  if (IsSceneFile(last)) ReadSceneFile(last, &config, places);
  const std::string scene = config.scene;
  for (const YamlValue& tree : trees) {
    YamlReader reader(tree, places);
    Describe(reader, config);
    reader.Finish();
    // Removed after each layer, so that the next layer sees the motors of the printed
    // configuration. A layer that lists all motors, as a printed configuration does, must itself
    // leave out the locked ones.
    LeaveOutLocked(&config.robots[0].spec, &left_out);
    const YamlValue* robot = tree.Find("robot");
    const YamlValue* motors = robot == nullptr ? nullptr : robot->Find("motors");
    if (motors != nullptr && motors->kind == YamlValue::Kind::kSequence) {
      left_out.insert(config.robots[0].spec.locked_joints.begin(),
                      config.robots[0].spec.locked_joints.end());
    }
  }
  CheckLocked(config.robots[0].spec, left_out, *places);
  if (IsSceneFile(last)) config.scene = scene;
  return config;
}

// The value at a path of nested mappings, null if there is none.
const YamlValue* FindAt(const YamlValue& tree, std::initializer_list<std::string_view> path) {
  const YamlValue* value = &tree;
  for (const std::string_view key : path) {
    if (value->kind != YamlValue::Kind::kMap) return nullptr;
    value = value->Find(key);
    if (value == nullptr) return nullptr;
  }
  return value;
}

// Whether a layer after the robot's own, the first `own`, names another model while none of them
// sets robot.dynamics.use.
bool LeavesJointsToAnotherModel(const std::vector<YamlValue>& trees, std::size_t own) {
  const YamlValue* own_model = nullptr;
  bool another = false;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    if (const YamlValue* model = FindAt(trees[i], {"robot", "model"})) {
      if (i < own) own_model = model;
      another = own_model == nullptr || model->text != own_model->text;
    }
    if (i < own) continue;
    const YamlValue* dynamics = FindAt(trees[i], {"robot", "dynamics"});
    if (dynamics == nullptr) continue;
    const bool scalar = dynamics->kind == YamlValue::Kind::kScalar;
    if (scalar || dynamics->Find("use") != nullptr) return false;
  }
  return another;
}

// The value of that key of `robot` in the last layer that has it, else null.
const YamlValue* LastOfRobot(const std::vector<YamlValue>& trees, std::string_view key) {
  const YamlValue* last = nullptr;
  for (const YamlValue& tree : trees) {
    const YamlValue* robot = tree.Find("robot");
    const YamlValue* value = robot == nullptr ? nullptr : robot->Find(key);
    if (value != nullptr) last = value;
  }
  return last;
}

std::string Listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// A hint such as "; g1_23dof has: understudy run g1_23dof --revision 10", "" if no robot has the
// revision.
std::string WhoHas(const std::string& revision, const std::filesystem::path& data_dir) {
  for (const std::string& robot : RobotNames(data_dir)) {
    if (ReadRobotFile(robot, data_dir).FindRevision(revision) == nullptr) continue;
    return "; " + robot + " has: understudy run " + robot + " --revision " + revision;
  }
  return "";
}

// The layers of the revision that the trees select; empty if they select none. A revision that is
// not text is refused later, when it is read.
std::vector<YamlValue> ChosenRevision(const RobotFile& file, const std::vector<YamlValue>& trees,
                                      const std::filesystem::path& data_dir) {
  const YamlValue* asked = LastOfRobot(trees, "revision");
  if (asked == nullptr || asked->text.empty()) return {};
  if (const RobotVariant* found = file.FindRevision(asked->text)) return found->trees;
  const std::vector<std::string> names = file.RevisionNames();
  // A printed configuration used as a robot's file names its revision and lists no others.
  const YamlValue* own = LastOfRobot(file.trees, "revision");
  if (names.empty() && own != nullptr && own->text == asked->text) return {};
  throw ConfigError(asked->where + ": robot.revision: this robot has no revision '" +
                    OneLine(asked->text) + "'" +
                    (names.empty() ? ", nor any other"
                                   : "; it has " + Listed(names) + WhoHas(asked->text, data_dir)));
}

// The layers of the firmware that the trees select. One that is no version is refused later.
std::vector<YamlValue> ChosenFirmware(const RobotFile& file, const std::vector<YamlValue>& trees) {
  const YamlValue* asked = LastOfRobot(trees, "firmware");
  if (asked == nullptr || !robot::IsFirmware(asked->text)) return {};
  const RobotVariant* found = file.FindFirmware(asked->text);
  return found == nullptr ? std::vector<YamlValue>() : found->trees;
}

// The layer of the hands that the trees select; empty if they select none.
std::vector<YamlValue> ChosenHands(const std::vector<YamlValue>& trees,
                                   const std::filesystem::path& data_dir) {
  const YamlValue* asked = LastOfRobot(trees, "hand_make");
  if (asked == nullptr) return {};
  std::vector<std::string> makes;
  if (const YamlValue* list = LastOfRobot(trees, "hand_makes")) {
    for (const YamlValue& make : list->items) makes.push_back(make.text);
  }
  std::vector<std::string> models;  // the robot's, then of those that it extends
  for (auto tree = trees.rbegin(); tree != trees.rend(); ++tree) {
    const YamlValue* robot = tree->Find("robot");
    const YamlValue* model = robot == nullptr ? nullptr : robot->Find("model");
    if (model != nullptr) models.push_back(model->text);
  }
  return {HandsOf(*asked, makes, models, data_dir)};
}

// The configuration of one robot, alone in its world, of its file and the layers above.
Config LoadAlone(const RobotFile& file, std::vector<YamlValue> layers,
                 const std::filesystem::path& data_dir) {
  std::vector<YamlValue> trees = file.trees;
  std::ranges::move(layers, std::back_inserter(trees));
  std::vector<YamlValue> chosen = ChosenRevision(file, trees, data_dir);
  std::ranges::move(ChosenFirmware(file, trees), std::back_inserter(chosen));
  std::ranges::move(ChosenHands(trees, data_dir), std::back_inserter(chosen));
  std::size_t own = file.trees.size() + chosen.size();
  trees.insert(trees.begin() + static_cast<std::ptrdiff_t>(file.trees.size()), chosen.begin(),
               chosen.end());
  const std::string profile = AddProfile(data_dir, own, &trees);
  if (!profile.empty()) ++own;
  Places places;
  Config config = ReadLayers(trees, &places);
  config.robots[0].profile = profile;
  if (LeavesJointsToAnotherModel(trees, own)) {
    config.robots[0].spec.dynamics.use = robot::DynamicsSource::kCatalogue;
  }
  TakeLimitsOfTypes(&config.robots[0].spec);
  config.robots[0].name = config.robots[0].spec.name;
  StrewObjects(&config);
  Validate(config, places);
  return config;
}

}  // namespace

Config LoadConfig(const Layers& layers, const std::filesystem::path& data_dir) {
  std::vector<YamlValue> trees;
  AddTrees(layers, &trees);
  std::vector<std::string> named = layers.others;
  if (!layers.robot.empty()) named.insert(named.begin(), layers.robot);
  const std::vector<RobotLayers> robots = SplitByRobot(named, trees, data_dir);
  if (robots.empty()) return LoadAlone(ReadRobotFile(layers.robot, data_dir), trees, data_dir);
  Config config;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    Config one = LoadAlone(robots[i].file, robots[i].trees, data_dir);
    Place(robots[i], i, &one.robots[0]);
    if (i == 0) {
      config = std::move(one);
    } else {
      config.robots.push_back(std::move(one.robots[0]));
    }
  }
  RequireOwnNetworks(config.robots);
  return config;
}

Config LoadConfig(const RobotFile& file, const Layers& layers,
                  const std::filesystem::path& data_dir) {
  std::vector<YamlValue> trees;
  AddTrees(layers, &trees);
  return LoadAlone(file, std::move(trees), data_dir);
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
  Config copy = config;  // an archive takes mutable values
  Printer printer(with_comments);
  Describe(printer, copy);
  return printer.text();
}

emulator::WorldSettings WorldSettingsOf(const Config& config) {
  return {.speed = config.time.speed,
          .reset_on_divergence = config.physics.on_divergence == DivergenceAction::kReset,
          .ground_friction = config.terrain.friction,
          .keys = SettingKeys()};
}

std::string StartPoseOf(const RobotConfig& config) {
  if (!config.start.pose.empty()) return config.start.pose;
  const bool released = authority::StartService(config.spec, config.motion).empty();
  const bool stands = config.spec.default_start == "standing";
  return stands && released && IsQuadruped(config.spec.kind) ? "lying" : config.spec.default_start;
}

emulator::RobotSettings RobotSettingsOf(const RobotConfig& config) {
  const std::string pose = StartPoseOf(config);
  return {.sensors = config.sensors,
          .gate = config.gate,
          .motion = config.motion,
          .crane = config.crane,
          .start = robot::FindStartPose(pose).value_or(robot::StartPose::kLying),
          .boot = config.start.boot,
          .faults = config.faults};
}

void TakeSettings(const emulator::WorldSettings& settings, Config* config) {
  config->physics.on_divergence =
      settings.reset_on_divergence ? DivergenceAction::kReset : DivergenceAction::kStop;
  config->terrain.friction = settings.ground_friction;
}

void TakeSettings(const emulator::RobotSettings& settings, RobotConfig* config) {
  config->sensors = settings.sensors;
  config->gate = settings.gate;
  config->motion = settings.motion;
  config->crane = settings.crane;
}

}  // namespace understudy::config
