#include "config/model_files.h"

#include <algorithm>
#include <system_error>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "config/data_dir.h"

namespace understudy::config {
namespace {

std::filesystem::path FindFile(const std::string& scene) {
  const std::filesystem::path folder = DataDir() / "models" / "scene";
  const std::filesystem::path path(scene);
  std::filesystem::path file = path.has_extension() ? path : folder / (scene + ".xml");
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) return file;
  if (path.has_extension()) throw ModelError("scene " + scene + ": no such file");
  std::vector<std::string> scenes = terrain::GeneratedScenes();
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".xml") continue;
    const std::string name = entry.path().stem();
    if (std::find(scenes.begin(), scenes.end(), name) == scenes.end()) scenes.push_back(name);
  }
  throw ModelError("no scene '" + scene + "'" + DidYouMean(scene, scenes));
}

}  // namespace

std::filesystem::path ModelFile(const robot::RobotSpec& robot) {
  return DataDir() / "models" / robot.model;  // an absolute path replaces what is before it
}

std::vector<std::filesystem::path> HandModelFiles(const robot::RobotSpec& robot) {
  std::vector<std::filesystem::path> files;
  for (const robot::HandSpec& hand : robot.hands) {
    for (const std::string& model : hand.models) files.push_back(DataDir() / "models" / model);
  }
  return files;
}

SceneFile::SceneFile(const std::string& scene, const terrain::TerrainSpec& terrain) {
  const bool is_scan = mjcf::IsMeshFile(scene);
  if (!terrain::IsTerrain(scene) && !is_scan) {
    path_ = sight_ = FindFile(scene);
    return;
  }
  try {
    made_.emplace("scene");
  } catch (const SetupError& error) {
    throw ModelError(error.what());
  }
  path_ = sight_ = made_->path() / "scene.xml";
  if (!is_scan) {
    terrain::WriteTerrain(scene, terrain, made_->path());
    return;
  }
  scan_ = std::make_shared<const terrain::Scan>(terrain::ReadScan(FindFile(scene), terrain.scan));
  terrain::WriteScan(*scan_, terrain, made_->path());
  sight_ = made_->path() / "sight.xml";
}

}  // namespace understudy::config
