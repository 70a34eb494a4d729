// A robot's file: what it extends, what it says itself, and its hardware revisions.
//
//   extends: g1                  # another robot, or a YAML file seen from this one
//   robot:
//     name: g1_23dof
//     motors:                    # of a list only what differs, by name or index
//       left_knee_joint: {hold_kp: 80}
//     revision: 4                # unless somebody says otherwise
//     revisions:                 # each as it would stand under `robot`
//       4: {mode_machine: 4}
//       10: {mode_machine: 10, motors: {left_hip_pitch_joint: {torque_limit: 139}}}
//       5:                       # nothing: not one of this robot, though of the one it extends
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/yaml_document.h"

namespace understudy::config {

// A hardware revision: layers that go right over those of the robot, weakest first.
struct RobotRevision {
  std::string name;
  std::vector<YamlValue> trees;
};

struct RobotFile {
  std::vector<YamlValue> trees;          // weakest first: what it extends, then the file itself
  std::vector<RobotRevision> revisions;  // in the order of the files

  // Null where there is none of that name.
  const RobotRevision* FindRevision(const std::string& name) const;
  std::vector<std::string> RevisionNames() const;
};

// The robots that have a file in data_dir/config/robots, in alphabetical order.
std::vector<std::string> RobotNames(const std::filesystem::path& data_dir);

// Reads a YAML file that lies over a robot. A model that lies beside the file that names it becomes
// absolute. Throws ConfigError.
YamlValue ReadLayer(const std::filesystem::path& file);

// `robot` is a name in data_dir/config/robots, or the path of a YAML file (has '/' or ends .yaml).
// Keys that no robot has are not looked at here. Throws ConfigError for a robot that is unknown, a
// file that cannot be read, one that extends itself, and for revisions that are no mapping of
// mappings or take away what is not there.
RobotFile ReadRobotFile(const std::string& robot, const std::filesystem::path& data_dir);

}  // namespace understudy::config
