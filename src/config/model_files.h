// Which files a robot and a scene stand for.
#pragma once

#include <filesystem>
#include <string>

#include "robot/robot_spec.h"
#include "terrain/terrain.h"

namespace understudy::config {

// The robot's MJCF: below the data directory's models, or the absolute path its description names.
std::filesystem::path ModelFile(const robot::RobotSpec& robot);

// The MJCF file of a scene. Ground that is made stands in a temporary folder that goes with this
// object.
class SceneFile {
 public:
  // A kind of terrain or row is made; another word is a file in models/scene, anything with an
  // extension a path. Throws ModelError: what WriteTerrain throws, or, where there is no such file,
  // the scenes there are and the nearest of them.
  SceneFile(const std::string& scene, const terrain::TerrainSpec& terrain);
  ~SceneFile();
  SceneFile(const SceneFile&) = delete;
  SceneFile& operator=(const SceneFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::filesystem::path made_;  // the folder; empty where nothing was made
};

}  // namespace understudy::config
