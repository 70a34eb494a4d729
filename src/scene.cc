#include "scene.h"

#include <algorithm>
#include <vector>

#include "config/data_dir.h"
#include "robot/errors.h"
#include "robot/nearest_word.h"

namespace understudy {

std::filesystem::path ModelFile(const RobotSpec& robot) {
  return DataDir() / "models" / robot.model;  // an absolute path replaces what is before it
}

std::filesystem::path SceneFile(const std::string& scene) {
  const std::filesystem::path folder = DataDir() / "models" / "scene";
  const std::filesystem::path path(scene);
  std::filesystem::path file = path.has_extension() ? path : folder / (scene + ".xml");
  if (std::filesystem::is_regular_file(file)) return file;
  std::vector<std::string> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    scenes.push_back(entry.path().stem());
  }
  std::sort(scenes.begin(), scenes.end());
  throw ModelError("no scene '" + scene + "'" + DidYouMean(scene, scenes));
}

}  // namespace understudy
