#include "mjcf/urdf_meshes.h"

#include <algorithm>
#include <cctype>
#include <system_error>

#include "base/errors.h"
#include "mjcf/dae.h"
#include "mjcf/joints.h"
#include "mjcf/stl.h"
#include "mjcf/urdf_elements.h"

namespace understudy::mjcf {
namespace {

using Eigen::Vector3d;
using std::filesystem::path;

constexpr char kPackage[] = "package://";

std::string EndingOf(const path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

std::vector<UrdfMeshes::Part> UrdfMeshes::Take(const MjcfElement& mesh) {
  const std::string name = NeededIn(mesh, "filename");
  const Vector3d scale = VectorIn(&mesh, "scale", Vector3d::Ones());
  const path file = Find(name);
  const std::string ending = EndingOf(file);
  const auto fail = [&](const std::string& why) { FailAt(mesh, "mesh " + name + ": " + why); };
  if (file.empty()) fail("no such file in " + folder_.string() + " or the folders above");
  const bool dae = ending == ".dae";
  if (!dae && ending != ".stl" && ending != ".obj" && ending != ".msh") {
    fail("expected STL, OBJ, MSH or DAE; convert it");
  }
  const std::vector<Made>* made = nullptr;
  try {
    made = &FilesOf(file, dae && dae_ == DaeUse::kRead);
  } catch (const ModelError& error) {
    fail(error.what());
  }
  std::vector<Part> parts;
  for (const Made& one : *made) {
    const auto [asset, is_new] = names_.try_emplace(one.to + " " + TextOf(scale), "");
    if (is_new) {
      asset->second = path(one.to).stem().string() + "_" + std::to_string(names_.size());
      MjcfElement element{"mesh", {}, {}, mesh.place};
      element.Set("name", asset->second);
      element.Set("file", one.to);
      if (scale != Vector3d::Ones()) element.Set("scale", TextOf(scale));
      assets_.push_back(std::move(element));
    }
    parts.push_back({asset->second, one.rgba});
  }
  return parts;
}

// Returns the file of a mesh, "" if there is none.
path UrdfMeshes::Find(std::string name) const {
  std::error_code ignored;
  if (name.starts_with("file://")) name.erase(0, 7);
  std::vector<path> tails{name};
  if (name.starts_with(kPackage)) {
    const path tail = name.substr(sizeof kPackage - 1);
    tails = {tail, tail.lexically_relative(*tail.begin())};  // with its package and without
  }
  for (path folder = folder_;; folder = folder.parent_path()) {
    for (const path& tail : tails) {
      if (std::filesystem::is_regular_file(folder / tail, ignored)) return folder / tail;
    }
    if (folder == folder.parent_path()) return {};
  }
}

// Files of one name from several folders get a number.
std::string UrdfMeshes::FreeName(const std::string& stem, const std::string& ending) const {
  std::string to = "meshes/" + stem + ending;
  for (int n = 2; std::ranges::find(files_, to, &UrdfReadMesh::to) != files_.end(); ++n) {
    to = "meshes/" + std::to_string(n) + "_" + stem + ending;
  }
  return to;
}

// Returns the files made of a file, which is read at the first call for it.
const std::vector<UrdfMeshes::Made>& UrdfMeshes::FilesOf(const path& file, bool convert) {
  const auto found = made_.find(file);
  if (found != made_.end()) return found->second;
  std::vector<Made> made;
  if (!convert) {
    made.push_back({FreeName(file.stem().string(), file.extension().string()), std::nullopt});
    files_.push_back({file, made.back().to, ""});
    return made_[file] = std::move(made);
  }
  for (const MeshPart& part : ReadDae(file)) {
    for (std::string& stl : Stls(part.corners)) {
      made.push_back({FreeName(file.stem().string(), ".stl"), part.rgba});
      files_.push_back({file, made.back().to, std::move(stl)});
    }
  }
  return made_[file] = std::move(made);
}

}  // namespace understudy::mjcf
