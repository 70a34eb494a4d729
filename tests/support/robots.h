// The robots of the repository, for tests that hold for each of a kind.
#pragma once

#include <string>
#include <vector>

#include "config/load.h"
#include "config/robot_file.h"

namespace understudy::test {

inline robot::RobotSpec ShippedRobot(const std::string& name) {
  return config::LoadConfig({.robot = name, .files = {}, .sets = {}}, UNDERSTUDY_SOURCE_DIR).robot;
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
