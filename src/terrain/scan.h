// A user's scan of a place as a scene.
#pragma once

#include <filesystem>
#include <vector>

#include "mjcf/mesh_file.h"
#include "terrain/terrain.h"

namespace understudy::terrain {

// Triangles in the world [m], by colour.
using Scan = std::vector<mjcf::MeshPart>;

// Reads a mesh file and puts it where `spec` says. Throws ModelError as ReadMeshFile does, and if
// the quaternion is 0, or the scan is larger than 200 m.
Scan ReadScan(const std::filesystem::path& file, const ScanSpec& spec);

// Writes folder/scene.xml, as WriteTerrain does: one height field, the highest surfaces of the scan
// up to spec.height, which is what robots touch. Where nothing was scanned it has the height of
// what is next. Also folder/sight.xml with the scan's triangles, which cameras see and nothing
// touches, and their files. Throws ModelError if nothing lies below
// spec.height, spec.cell is so small that the scan would be sampled more than 300 million times, or
// a file cannot be written.
void WriteScan(const Scan& scan, const TerrainSpec& spec, const std::filesystem::path& folder);

}  // namespace understudy::terrain
