// The files that a model's assets name: meshes, pictures, height fields.
#pragma once

#include <filesystem>
#include <string>

#include "mjcf/document.h"

namespace understudy::mjcf {

// Makes the file names of textures (file, fileright, ...), meshes, height fields, skins, flexible
// bodies and attached models absolute: they are looked for from `folder` and from the <compiler>'s
// assetdir, meshdir and texturedir, which are then dropped. Checks nothing.
void MakeAssetsAbsolute(MjcfElement* root, const std::filesystem::path& folder);

// Why this element's files cannot be read, "" where they can or it names none: one is not there, or
// is a Git LFS pointer that stands for the file.
std::string WhatAssetLacks(const MjcfElement& element);

// Throws ModelError, with file and line, for the first file that cannot be read; how many more
// there are is said as well.
void RequireAssets(const MjcfElement& root);

}  // namespace understudy::mjcf
