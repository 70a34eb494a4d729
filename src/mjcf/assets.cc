#include "mjcf/assets.h"

#include <fstream>
#include <system_error>
#include <vector>

#include "base/errors.h"

namespace understudy::mjcf {
namespace {

using std::filesystem::path;

// The beginning of a Git LFS pointer, which replaces a large file that was not fetched.
constexpr std::string_view kLfsPointer = "version https://git-lfs";

// Where MuJoCo searches the files of assets.
struct AssetFolders {
  path main, mesh, texture;
  bool strip = false;  // use only the last part of a file name
};

bool InMeshes(const std::string& kind) {
  return kind == "mesh" || kind == "hfield" || kind == "skin" || kind == "flexcomp";
}

bool NamesFile(const MjcfElement& element, const std::string& attribute, const std::string& value) {
  const std::string& kind = element.name;
  return (InMeshes(kind) || kind == "texture" || kind == "model") &&
         attribute.starts_with("file") && !value.empty();
}

// Later <compiler> elements override earlier ones, as in MuJoCo.
AssetFolders TakeAssetFolders(MjcfElement* root, const path& folder) {
  AssetFolders folders{folder, folder, folder};
  for (MjcfElement& compiler : root->children) {
    if (compiler.name != "compiler") continue;
    if (const auto* both = compiler.Find("assetdir")) {
      folders.mesh = folders.texture = folder / *both;
    }
    if (const auto* mesh = compiler.Find("meshdir")) folders.mesh = folder / *mesh;
    if (const auto* texture = compiler.Find("texturedir")) folders.texture = folder / *texture;
    if (const auto* strip = compiler.Find("strippath")) folders.strip = *strip == "true";
    for (const char* spent : {"assetdir", "meshdir", "texturedir", "strippath"}) {
      compiler.Drop(spent);
    }
  }
  return folders;
}

void MakeAbsolute(MjcfElement* element, const AssetFolders& folders) {
  const path& folder = InMeshes(element->name)
                           ? folders.mesh
                           : (element->name == "texture" ? folders.texture : folders.main);
  for (auto& [name, value] : element->attributes) {
    if (!NamesFile(*element, name, value)) continue;
    const path asked = folders.strip ? path(value).filename() : path(value);
    value = std::filesystem::absolute(folder / asked).lexically_normal().string();
  }
  for (MjcfElement& child : element->children) MakeAbsolute(&child, folders);
}

bool IsLfsPointer(const path& file) {
  std::string begin(kLfsPointer.size(), '\0');
  std::ifstream stream(file, std::ios::binary);
  return stream.read(begin.data(), static_cast<std::streamsize>(begin.size())) &&
         begin == kLfsPointer;
}

void Collect(const MjcfElement& element, std::vector<std::string>* lacks) {
  if (const std::string text = WhatAssetLacks(element); !text.empty()) {
    lacks->push_back(element.place.text() + ": " + text);
  }
  for (const MjcfElement& child : element.children) Collect(child, lacks);
}

}  // namespace

void MakeAssetsAbsolute(MjcfElement* root, const std::filesystem::path& folder) {
  MakeAbsolute(root, TakeAssetFolders(root, folder));
}

std::string WhatAssetLacks(const MjcfElement& element) {
  for (const auto& [name, value] : element.attributes) {
    if (!NamesFile(element, name, value)) continue;
    const std::string what = "<" + element.name + "> " + name + ": ";
    std::error_code error;
    if (!std::filesystem::is_regular_file(value, error)) return what + "no file " + value;
    if (IsLfsPointer(value)) {
      return what + value + " is a Git LFS pointer; `git lfs pull` there fetches the file itself";
    }
  }
  return "";
}

void RequireAssets(const MjcfElement& root) {
  std::vector<std::string> lacks;
  Collect(root, &lacks);
  if (lacks.empty()) return;
  std::string text = lacks.front();
  if (lacks.size() > 1) {
    text += "; the model lacks " + std::to_string(lacks.size() - 1) + " more of its files";
  }
  throw ModelError(text);
}

}  // namespace understudy::mjcf
