// Reads meshes of COLLADA (.dae), which many URDFs have and MuJoCo does not read.
#pragma once

#include <filesystem>
#include <vector>

#include "mjcf/mesh_file.h"

namespace understudy::mjcf {

// Reads the visual scene of a file: triangles, polylists and polygons of its geometries where its
// nodes put them, in the unit of length that it names. What it says of the axis that is up is not
// heeded, as ROS does not: many exporters always name y.
// Colours are the diffuse ones of its materials; textures are not read. Lines, cameras and lights
// are passed over.
//
// Throws ModelError, with the file and where known the line, for what is no COLLADA, has no
// triangles or other shapes than those, names what is not there, or is too large: 64 MiB, 4 million
// triangles, 50 levels of nodes, 100000 nodes.
std::vector<MeshPart> ReadDae(const std::filesystem::path& file);

}  // namespace understudy::mjcf
