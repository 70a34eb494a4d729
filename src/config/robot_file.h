// Reads a robot's file: the robot it extends, its own keys, and its hardware revisions.
//
//   extends: g1                  # another robot, or a YAML file seen from this one
//   robot:
//     name: g1_23dof
//     motors:                    # only what differs, by name or index
//       left_knee_joint: {hold_kp: 80}
//     revision: 4                # the default
//     revisions:                 # keys of `robot`, by revision
//       4: {mode_machine: 4}
//       10: {mode_machine: 10, motors: {left_hip_pitch_joint: {torque_limit: 139}}}
//       5:                       # empty: removes a revision of the robot it extends
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/yaml_document.h"

namespace understudy::config {

// A hardware revision: layers to be read directly after those of the robot, weakest first.
struct RobotRevision {
  std::string name;
  std::vector<YamlValue> trees;
};

struct RobotFile {
  std::vector<YamlValue> trees;          // weakest first: what it extends, then the file itself
  std::vector<RobotRevision> revisions;  // in the order of the files

  // Returns null if there is no revision of that name.
  const RobotRevision* FindRevision(const std::string& name) const;
  std::vector<std::string> RevisionNames() const;
};

// Returns the names of the robots in data_dir/config/robots, in alphabetical order.
std::vector<std::string> RobotNames(const std::filesystem::path& data_dir);

// Reads a --config file. A relative `robot.model` beside the file becomes absolute. Throws
// ConfigError.
YamlValue ReadLayer(const std::filesystem::path& file);

// Reads the file of `robot`: a name in data_dir/config/robots, or the path of a YAML file (has '/'
// or ends .yaml). Does not look for unknown keys. Throws ConfigError for an unknown robot, a file
// that cannot be read or extends itself, and for revisions that are not a mapping of mappings or
// remove one that does not exist.
RobotFile ReadRobotFile(const std::string& robot, const std::filesystem::path& data_dir);

}  // namespace understudy::config
