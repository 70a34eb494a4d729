// Finds the files of a model's assets: meshes, textures, height fields.
#pragma once

#include <filesystem>
#include <string>

#include "mjcf/document.h"

namespace understudy::mjcf {

// Makes the file names of textures (file, fileright, ...), meshes, height fields, skins, flexible
// bodies and attached models absolute, relative to `folder` and the <compiler>'s assetdir, meshdir
// and texturedir, which are then removed. Does not check that they exist.
void MakeAssetsAbsolute(MjcfElement* root, const std::filesystem::path& folder);

// Returns why the element's files cannot be read: one is missing, or is a Git LFS pointer. "" if
// they can or it names none.
std::string WhatAssetLacks(const MjcfElement& element);

// Throws ModelError, with file and line, for the first file that cannot be read, and with the
// number of further ones.
void RequireAssets(const MjcfElement& root);

}  // namespace understudy::mjcf
