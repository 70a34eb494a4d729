// Reads a robot's file: the robot it extends, its own keys, its hardware revisions and what differs
// by firmware.
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
//     firmware: "1.5.3"          # the default
//     firmwares:                 # keys of `robot`, by the first version that they hold for
//       "1.0": {apis: [loco_g1]}
//       "1.4": {}                # as the robot's own keys say
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "schema/yaml_document.h"

namespace understudy::config {

using schema::YamlValue;

// The key by which a robot's file names the one that it extends.
inline constexpr char kExtends[] = "extends";

// A hardware revision or a firmware: layers to be read after those of the robot, weakest first;
// those of a firmware after those of a revision.
struct RobotVariant {
  std::string name;
  std::vector<YamlValue> trees;
};

struct RobotFile {
  // Weakest first: data_dir/config/motors.yaml, what it extends, then the file itself.
  std::vector<YamlValue> trees;
  std::vector<RobotVariant> revisions;  // in the order of the files
  std::vector<RobotVariant>
      firmwares;  // in the order of the files, each named by its first version

  // Returns null if there is no revision of that name.
  const RobotVariant* FindRevision(const std::string& name) const;
  std::vector<std::string> RevisionNames() const;
  // Returns the newest firmware that is not newer than `version`, which must be robot::IsFirmware;
  // null if there is none.
  const RobotVariant* FindFirmware(const std::string& version) const;
  std::vector<std::string> FirmwareNames() const;
};

// Returns the names of the robots in data_dir/config/robots, in alphabetical order.
std::vector<std::string> RobotNames(const std::filesystem::path& data_dir);

// Reads a --config file. The path of a model or policy that stands beside the file
// becomes absolute. Throws
// ConfigError.
YamlValue ReadLayer(const std::filesystem::path& file);

// Reads the file of `robot`: a name in data_dir/config/robots, or the path of a YAML file (has '/'
// or ends .yaml). Does not look for unknown keys. Throws ConfigError for an unknown robot, a file
// that cannot be read or extends itself, and for revisions or firmwares that are not a mapping of
// mappings or remove one that does not exist, and for a firmware that is no version.
// `where` begins the message of an unknown robot.
RobotFile ReadRobotFile(const std::string& robot, const std::filesystem::path& data_dir,
                        const std::string& where = "");

// Returns whether a robot is named by the path of a file.
bool IsRobotPath(const std::string& robot);

}  // namespace understudy::config
