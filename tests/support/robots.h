// The robots of the repository, for tests that hold for each of a kind.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "config/load.h"
#include "config/robot_file.h"

namespace understudy::test {

// Reads each robot once: every test is a process of its own, which asks for all of them as it
// starts.
inline const robot::RobotSpec& ShippedRobot(const std::string& name) {
  static std::map<std::string, robot::RobotSpec> read;
  const auto [at, is_new] = read.try_emplace(name);
  if (is_new)
    at->second = config::LoadConfig({.robot = name}, UNDERSTUDY_SOURCE_DIR).robots[0].spec;
  return at->second;
}

// Those of which `is_meant` holds, by name.
template <class Predicate>
std::vector<std::string> RobotsThat(Predicate is_meant) {
  std::vector<std::string> names = config::RobotNames(UNDERSTUDY_SOURCE_DIR);
  std::erase_if(names, [&](const std::string& name) { return !is_meant(ShippedRobot(name)); });
  return names;
}

inline std::vector<std::string> Robots() { return config::RobotNames(UNDERSTUDY_SOURCE_DIR); }
inline std::vector<std::string> Quadrupeds() {  // on feet or wheels
  return RobotsThat([](const robot::RobotSpec& spec) { return robot::IsQuadruped(spec.kind); });
}
inline std::vector<std::string> WheeledRobots() {
  return RobotsThat(
      [](const robot::RobotSpec& spec) { return spec.kind == robot::RobotKind::kWheeled; });
}
inline std::vector<std::string> Humanoids() {
  return RobotsThat(
      [](const robot::RobotSpec& spec) { return spec.kind == robot::RobotKind::kHumanoid; });
}
inline std::vector<std::string> HumanoidsWithoutHands() {
  return RobotsThat([](const robot::RobotSpec& spec) {
    return spec.kind == robot::RobotKind::kHumanoid && spec.hands.empty();
  });
}

}  // namespace understudy::test
