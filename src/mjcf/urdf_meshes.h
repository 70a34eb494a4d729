// Collects the meshes of a URDF: finds their files and makes assets of MJCF. Private to mjcf/.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mjcf/document.h"
#include "mjcf/urdf_reader.h"

namespace understudy::mjcf {

class UrdfMeshes {
 public:
  // `folder` is the URDF's.
  UrdfMeshes(std::filesystem::path folder, DaeUse dae) : folder_(std::move(folder)), dae_(dae) {}

  // An asset, and the colour that its file gives it; nullopt: none.
  struct Part {
    std::string asset;
    std::optional<std::array<double, 4>> rgba;
  };

  // Returns the assets of a <mesh>: one, but of a .dae one for each colour. Throws ModelError, with
  // file and line, where there is no such file or MuJoCo cannot read it.
  std::vector<Part> Take(const MjcfElement& mesh);

  // What was taken: <mesh> elements of MJCF, and the files that they name.
  std::vector<MjcfElement> TakeAssets() { return std::move(assets_); }
  std::vector<UrdfReadMesh> TakeFiles() { return std::move(files_); }

 private:
  // A mesh file of the model, and the colour of what is in it.
  struct Made {
    std::string to;
    std::optional<std::array<double, 4>> rgba;
  };

  std::filesystem::path Find(std::string name) const;
  const std::vector<Made>& FilesOf(const std::filesystem::path& file, bool convert);
  std::string FreeName(const std::string& stem, const std::string& ending) const;

  std::filesystem::path folder_;
  DaeUse dae_;
  std::map<std::filesystem::path, std::vector<Made>> made_;  // by file
  std::map<std::string, std::string> names_;                 // of assets, by file and scale
  std::vector<MjcfElement> assets_;
  std::vector<UrdfReadMesh> files_;
};

}  // namespace understudy::mjcf
