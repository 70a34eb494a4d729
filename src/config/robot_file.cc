#include "config/robot_file.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <system_error>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "robot/firmware.h"

namespace understudy::config {
namespace {

using schema::MapOf;
using schema::OneLine;
using schema::ReadYamlFile;
using schema::TakeOut;
using schema::YamlNames;

using std::filesystem::path;

constexpr char kRevisions[] = "revisions";
constexpr char kFirmwares[] = "firmwares";

path NamedFile(const std::string& robot, const std::string& where, const path& data_dir) {
  const std::vector<std::string> names = RobotNames(data_dir);
  std::string name = robot;  // in any case of letters: the vendor writes `Go2`
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    constexpr std::string_view kVendor = "unitree_";
    const std::string meant = name.starts_with(kVendor) ? name.substr(kVendor.size()) : robot;
    throw ConfigError(where + "robot '" + OneLine(robot) + "': unknown" + DidYouMean(meant, names));
  }
  return data_dir / "config" / "robots" / (name + ".yaml");
}

void AddVariant(const std::string& name, YamlValue differences, const std::string& key,
                std::vector<RobotVariant>* variants) {
  const auto known = std::ranges::find(*variants, name, &RobotVariant::name);
  const bool is_known = known != variants->end();
  if (differences.kind == YamlValue::Kind::kNull && is_known) {
    variants->erase(known);
    return;
  }
  if (differences.kind != YamlValue::Kind::kMap) {
    throw ConfigError(differences.where + ": " + key + "." + OneLine(name) +
                      ": expected a mapping of keys, {} for none, got " + Shown(differences));
  }
  RobotVariant& variant = is_known ? *known : variants->emplace_back(RobotVariant{name, {}});
  variant.trees.push_back(MapOf("robot", std::move(differences)));
}

// Takes the variants under that key of `robot` out of it.
void TakeVariants(const char* word, YamlValue* robot, std::vector<RobotVariant>* variants) {
  std::optional<YamlValue> found = TakeOut(robot, word);
  if (!found) return;
  const std::string key = std::string("robot.") + word;
  if (found->kind != YamlValue::Kind::kMap) {
    throw ConfigError(found->where + ": " + key +
                      ": expected a mapping from names to what differs, got " + Shown(*found));
  }
  for (std::size_t i = 0; i < found->keys.size(); ++i) {
    AddVariant(found->keys[i].text, std::move(found->items[i]), key, variants);
  }
}

void CheckVersions(const YamlValue& tree, const std::vector<RobotVariant>& firmwares) {
  for (const RobotVariant& firmware : firmwares) {
    if (robot::IsFirmware(firmware.name)) continue;
    throw ConfigError(tree.where + ": robot." + kFirmwares + "." + OneLine(firmware.name) +
                      ": expected numbers between dots, as in 1.1.6");
  }
}

std::vector<std::string> NamesOf(const std::vector<RobotVariant>& variants) {
  std::vector<std::string> names;
  for (const RobotVariant& variant : variants) names.push_back(variant.name);
  return names;
}

// The file named by `extends`: a path relative to the extending file, or a robot's name.
path Extended(const YamlValue& extends, const path& file, const path& data_dir) {
  if (extends.kind != YamlValue::Kind::kScalar) {
    throw ConfigError(extends.where + ": " + kExtends + ": expected a robot's name or file, got " +
                      Shown(extends));
  }
  if (IsRobotPath(extends.text)) return file.parent_path() / extends.text;
  return NamedFile(extends.text, extends.where + ": " + kExtends + ": ", data_dir);
}

// Makes a relative path absolute if there is such a file beside `file`.
void FindBeside(const path& file, YamlValue* named) {
  if (named == nullptr || named->text.empty()) return;
  std::error_code error;
  const path beside = file.parent_path() / named->text;
  if (std::filesystem::exists(beside, error)) {
    named->text = std::filesystem::absolute(beside).lexically_normal().string();
  }
}

// `seen`: the files that extend this one, without itself.
void AddFile(const path& file, const path& data_dir, std::vector<path>* seen, RobotFile* result) {
  YamlValue tree = ReadLayer(file);
  seen->push_back(std::filesystem::weakly_canonical(file));
  if (const std::optional<YamlValue> extends = TakeOut(&tree, kExtends)) {
    const path parent = Extended(*extends, file, data_dir);
    std::error_code ignored;  // a file that cannot be looked at cannot be read either, said below
    const path same = std::filesystem::weakly_canonical(parent, ignored);
    if (std::find(seen->begin(), seen->end(), same) != seen->end()) {
      throw ConfigError(extends->where + ": " + kExtends + ": '" + OneLine(extends->text) +
                        "' extends this file in turn");
    }
    AddFile(parent, data_dir, seen, result);
  }
  YamlValue* robot = tree.Find("robot");
  if (robot != nullptr) {
    TakeVariants(kRevisions, robot, &result->revisions);
    TakeVariants(kFirmwares, robot, &result->firmwares);
    CheckVersions(*robot, result->firmwares);
  }
  result->trees.push_back(std::move(tree));
}

}  // namespace

const RobotVariant* RobotFile::FindRevision(const std::string& name) const {
  const auto found = std::ranges::find(revisions, name, &RobotVariant::name);
  return found == revisions.end() ? nullptr : &*found;
}

std::vector<std::string> RobotFile::RevisionNames() const { return NamesOf(revisions); }

const RobotVariant* RobotFile::FindFirmware(const std::string& version) const {
  const RobotVariant* newest = nullptr;
  for (const RobotVariant& firmware : firmwares) {
    if (!robot::FirmwareReaches(version, firmware.name)) continue;
    if (newest == nullptr || robot::FirmwareReaches(firmware.name, newest->name)) {
      newest = &firmware;
    }
  }
  return newest;
}

std::vector<std::string> RobotFile::FirmwareNames() const { return NamesOf(firmwares); }

std::vector<std::string> RobotNames(const path& data_dir) {
  return YamlNames(data_dir / "config" / "robots");
}

YamlValue ReadLayer(const path& file) {
  YamlValue tree = ReadYamlFile(file);
  FindBeside(file, tree.Find("look"));
  YamlValue* robot = tree.Find("robot");
  if (robot == nullptr) return tree;
  FindBeside(file, robot->Find("model"));
  if (YamlValue* services = robot->Find("services")) {
    for (YamlValue& service : services->items) FindBeside(file, service.Find("policy"));
  }
  return tree;
}

bool IsRobotPath(const std::string& robot) {
  return robot.find('/') != std::string::npos || robot.ends_with(".yaml");
}

RobotFile ReadRobotFile(const std::string& robot, const path& data_dir, const std::string& where) {
  RobotFile file;
  std::vector<path> seen;
  std::error_code error;
  const path motors = data_dir / "config" / "motors.yaml";
  if (std::filesystem::exists(motors, error)) file.trees.push_back(ReadYamlFile(motors));
  AddFile(IsRobotPath(robot) ? path(robot) : NamedFile(robot, where, data_dir), data_dir, &seen,
          &file);
  return file;
}

}  // namespace understudy::config
