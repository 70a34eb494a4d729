// Splits the layers of a configuration of several robots into those of each.
//
//   robots:
//     left: {robot: go2}                              # as on the command line
//     right:
//       robot: go2
//       start: {at: [0, 2, 0]}
//       network: {domain: 3}
//     mine: {extends: g1, robot: {locked_joints: [waist_yaw_joint]}}   # as a robot's file
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/robot_file.h"
#include "schema/yaml_document.h"

namespace understudy::config {

// From a robot to the next that names no place of its own, along y [m]; *assumed*: the vendor's
// largest robots pass each other.
inline constexpr double kRobotSpacing = 1.5;

// What one of several robots is made of.
struct RobotLayers {
  std::string name;  // in the world
  RobotFile file;
  std::vector<YamlValue> trees;  // weakest first: of each layer what all robots share, then its own
  bool has_network = false;      // its own layers say where it speaks
  bool has_place = false;        // its own layers say where it stands
};

// Returns the layers of each robot: of those that the command line names, in that order, and then
// of those that `robots` in a layer adds. Returns nothing if there is only one robot, with its keys
// beside the world's. A robot is named after its file, with a number where several have the same. A
// named file that has `robots` is a layer below the others. Throws ConfigError for a name that is
// not plain, a robot without a file, and a key that belongs to the world.
std::vector<RobotLayers> SplitByRobot(const std::vector<std::string>& named,
                                      const std::vector<YamlValue>& layers,
                                      const std::filesystem::path& data_dir);

// Gives a robot of several its name, and place and domain by its number where it has none of its
// own: kRobotSpacing to the left of the one before, and the domain after its.
void Place(const RobotLayers& layers, std::size_t number, RobotConfig* robot);

// Throws ConfigError if two robots are on one network.
void RequireOwnNetworks(const std::vector<RobotConfig>& robots);

}  // namespace understudy::config
