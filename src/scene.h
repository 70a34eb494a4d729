// Which files a robot and a scene stand for.
#ifndef UNDERSTUDY_SCENE_H_
#define UNDERSTUDY_SCENE_H_

#include <filesystem>
#include <string>

#include "robot/robot_spec.h"

namespace understudy {

// The robot's MJCF: below the data directory's models, or the absolute path its description names.
std::filesystem::path ModelFile(const RobotSpec& robot);

// A word is a file in models/scene, anything with an extension a path. Throws ModelError that names
// the scenes there are and the nearest of them when there is no such file.
std::filesystem::path SceneFile(const std::string& scene);

}  // namespace understudy

#endif  // UNDERSTUDY_SCENE_H_
