// Finds the MJCF file of a robot, and finds or makes that of a scene.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/temporary_folder.h"
#include "robot/robot_spec.h"
#include "terrain/scan.h"
#include "terrain/terrain.h"

namespace understudy::config {

// Returns the robot's MJCF file: robot.model below the data directory's models, or robot.model
// itself if it is absolute.
std::filesystem::path ModelFile(const robot::RobotSpec& robot);

// Returns the MJCF files of its hands, found in the same way.
std::vector<std::filesystem::path> HandModelFiles(const robot::RobotSpec& robot);

// The MJCF file of a scene. Generated ground, and what a scan becomes, is in a temporary folder
// that this object owns and removes.
class SceneFile {
 public:
  // Generates a kind of terrain or "row"; another word is a file in models/scene, a name with an
  // extension a path, of a scan if it is a mesh. Throws ModelError as WriteTerrain and ReadScan do,
  // or, if there is no such file, with the valid scenes and the nearest of them, or if there can be
  // no temporary folder.
  SceneFile(const std::string& scene, const terrain::TerrainSpec& terrain);
  const std::filesystem::path& path() const { return path_; }
  // What cameras see, and rays; path() and null where that is no scan.
  const std::filesystem::path& sight() const { return sight_; }
  const std::shared_ptr<const terrain::Scan>& scan() const { return scan_; }

 private:
  std::filesystem::path path_, sight_;
  std::shared_ptr<const terrain::Scan> scan_;
  std::optional<TemporaryFolder> made_;  // nullopt if nothing was made
};

}  // namespace understudy::config
