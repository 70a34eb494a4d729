#include "config/robots.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "config/keys.h"

namespace understudy::config {
namespace {

using schema::MapOf;
using schema::ReadYamlFile;
using schema::Shown;
using schema::TakeOut;
using std::filesystem::path;

constexpr char kRobots[] = "robots";
constexpr char kRobot[] = "robot";
constexpr std::size_t kLongestName = 32;
constexpr int kLastDomain = 232;

bool IsPlainLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

void RequirePlainName(const YamlValue& name) {
  const std::string& text = name.text;
  if (!text.empty() && text.size() <= kLongestName && std::ranges::all_of(text, IsPlainLetter))
    return;
  throw ConfigError(name.where +
                    ": robots: expected a name of at most 32 letters, digits and _, "
                    "got " +
                    Shown(name));
}

// The names of robots on the command line: of their files, with numbers where they are equal.
std::vector<std::string> NamesOf(const std::vector<std::string>& named) {
  std::vector<std::string> names;
  std::map<std::string, int> count;
  for (const std::string& robot : named) {
    std::string name = path(robot).stem().string().substr(0, kLongestName - 4);
    std::ranges::replace_if(
        name, [](char c) { return !IsPlainLetter(c); }, '_');
    ++count[name];
    names.push_back(std::move(name));
  }
  std::map<std::string, int> number;
  for (std::string& name : names) {
    if (count[name] > 1) name += "_" + std::to_string(++number[name]);
  }
  return names;
}

bool NamesRobots(const std::string& robot) {
  return IsRobotPath(robot) && ReadYamlFile(robot).Find(kRobots) != nullptr;
}

void RequireRobotKeys(const std::string& name, const YamlValue& entry) {
  if (entry.kind == YamlValue::Kind::kNull) return;
  if (entry.kind != YamlValue::Kind::kMap) {
    throw ConfigError(entry.where + ": robots." + name +
                      ": expected a mapping, as in {robot: go2}, got " + Shown(entry));
  }
  std::vector<std::string> known = RobotConfigKeys();
  known.emplace_back(kExtends);
  for (const YamlValue& key : entry.keys) {
    if (std::ranges::find(known, key.text) != known.end()) continue;
    throw ConfigError(key.where + ": robots." + name + ": unknown key " + Shown(key) +
                      DidYouMean(key.text, known) + "; those of the world stand beside robots");
  }
}

class Splitter {
 public:
  explicit Splitter(const path& data_dir) : data_dir_(data_dir) {}

  void Add(const std::string& name, RobotFile file) {
    robots_.push_back({.name = name, .file = std::move(file), .trees = {}});
    has_file_.push_back(true);
  }

  // Gives a layer to all robots, those that come with it too.
  void Add(YamlValue layer) {
    std::optional<YamlValue> own = TakeOut(&layer, kRobots);
    if (own && own->kind != YamlValue::Kind::kMap) {
      throw ConfigError(own->where +
                        ": robots: expected a mapping from names to robots, as in "
                        "{left: {robot: go2}}, got " +
                        Shown(*own));
    }
    for (std::size_t i = 0; own && i < own->keys.size(); ++i) {
      if (Find(own->keys[i].text) != robots_.size()) continue;
      RequirePlainName(own->keys[i]);
      robots_.push_back({.name = own->keys[i].text, .file = {}, .trees = shared_});
      has_file_.push_back(false);
    }
    if (layer.kind == YamlValue::Kind::kMap && !layer.keys.empty()) {
      for (RobotLayers& robot : robots_) robot.trees.push_back(layer);
      shared_.push_back(std::move(layer));
    }
    for (std::size_t i = 0; own && i < own->keys.size(); ++i) {
      AddOwn(Find(own->keys[i].text), std::move(own->items[i]));
    }
  }

  std::vector<RobotLayers> Finish() && { return std::move(robots_); }

 private:
  std::size_t Find(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(robots_, name, &RobotLayers::name) -
                                    robots_.begin());
  }

  void AddOwn(std::size_t number, YamlValue entry) {
    RobotLayers& robot = robots_[number];
    RequireRobotKeys(robot.name, entry);
    const std::optional<YamlValue> extends = TakeOut(&entry, kExtends);
    std::optional<YamlValue> described;
    const YamlValue* named = entry.Find(kRobot);
    const bool by_name = named != nullptr && named->kind == YamlValue::Kind::kScalar;
    if (extends || by_name || (named != nullptr && !has_file_[number])) {
      described = TakeOut(&entry, kRobot);
    }
    if (extends) {
      robot.file = ReadNamed(*extends);
    } else if (by_name) {
      robot.file = ReadNamed(*described);
    } else if (!described && !has_file_[number]) {
      throw ConfigError(entry.where + ": robots." + robot.name +
                        ": robot: missing; expected the name of a robot, as in {robot: go2}");
    }
    has_file_[number] = true;
    if (described && !by_name) robot.file.trees.push_back(MapOf(kRobot, *std::move(described)));
    robot.has_network = robot.has_network || entry.Find("network") != nullptr;
    const YamlValue* start = entry.Find("start");
    robot.has_place = robot.has_place || (start != nullptr && start->Find("at") != nullptr);
    if (entry.kind == YamlValue::Kind::kMap) robot.trees.push_back(std::move(entry));
  }

  RobotFile ReadNamed(const YamlValue& name) const {
    if (name.kind == YamlValue::Kind::kScalar) {
      return ReadRobotFile(name.text, data_dir_, name.where + ": ");
    }
    throw ConfigError(name.where + ": extends: expected a robot's name or file, got " +
                      Shown(name));
  }

  const path& data_dir_;
  std::vector<YamlValue> shared_;  // of the layers so far
  std::vector<RobotLayers> robots_;
  std::vector<bool> has_file_;  // by robot
};

}  // namespace

std::vector<RobotLayers> SplitByRobot(const std::vector<std::string>& named,
                                      const std::vector<YamlValue>& layers, const path& data_dir) {
  std::vector<std::string> single;
  std::vector<YamlValue> all;
  for (const std::string& robot : named) {
    if (NamesRobots(robot)) {
      all.push_back(ReadYamlFile(robot));
    } else {
      single.push_back(robot);
    }
  }
  all.insert(all.end(), layers.begin(), layers.end());
  const bool several = std::ranges::any_of(
      all, [](const YamlValue& layer) { return layer.Find(kRobots) != nullptr; });
  if (!several && single.size() <= 1) return {};
  Splitter splitter(data_dir);
  const std::vector<std::string> names = NamesOf(single);
  for (std::size_t i = 0; i < single.size(); ++i) {
    splitter.Add(names[i], ReadRobotFile(single[i], data_dir));
  }
  for (YamlValue& layer : all) splitter.Add(std::move(layer));
  return std::move(splitter).Finish();
}

void Place(const RobotLayers& layers, std::size_t number, RobotConfig* robot) {
  robot->name = layers.name;
  if (!layers.has_network) robot->network.domain += static_cast<int>(number);
  if (!layers.has_place) robot->start.at[1] += kRobotSpacing * static_cast<double>(number);
}

void RequireOwnNetworks(const std::vector<RobotConfig>& robots) {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const NetworkConfig& own = robots[i].network;
    const std::string key = "robots." + robots[i].name + ".network";
    if (own.domain > kLastDomain) {
      throw ConfigError(key + ".domain: expected 0 to 232, got " + std::to_string(own.domain));
    }
    for (std::size_t j = 0; j < i; ++j) {
      const NetworkConfig& other = robots[j].network;
      // Interfaces do not keep robots of one computer apart: Linux hands a multicast packet to all
      // sockets of its group, by whichever interface it comes.
      if (own.domain != other.domain || own.partition != other.partition) continue;
      throw ConfigError(key + ": " + robots[j].name + " is in domain " +
                        std::to_string(own.domain) +
                        (own.partition.empty() ? "" : ", partition " + own.partition) +
                        " too; give one of them another domain or partition, as with --set " + key +
                        ".domain=" + std::to_string(own.domain + 1));
    }
  }
}

}  // namespace understudy::config
