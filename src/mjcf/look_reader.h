// Reads what another copy of a model draws a robot with. Private to mjcf/.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "mjcf/document.h"
#include "mjcf/look.h"

namespace understudy::mjcf {

struct Bodies {
  // m, in their parents; nullopt for those of the world, which stand where a file likes
  std::map<std::string, std::optional<Eigen::Vector3d>> at;
  std::map<std::string, std::string> of_joint;  // the body that a joint moves
};

Bodies BodiesOf(const MjcfElement& root);

// Returns ".stl" of "a/B.STL".
std::string LowerEnding(const std::filesystem::path& file);

// Returns the meshes of the model `root` of `file`, by the bodies of the robot that they hang on;
// `lacks` is why the first one that cannot be read cannot, "" if all can. Throws ModelError with
// file and line for what is no number and for orientations other than quat, euler, axisangle.
Look ReadLook(std::filesystem::path file, const MjcfElement& root, const Bodies& robot,
              std::string* lacks);

}  // namespace understudy::mjcf
