// Reads the triangles of mesh files.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::mjcf {

// The triangles of one colour.
struct MeshPart {
  std::optional<std::array<double, 4>> rgba;  // 0 to 1; nullopt: the file gives them none
  std::vector<float> corners;  // nine numbers a triangle, in the file's unit; see Stl
};

// The geom that robots touch in place of a scan, which is seen.
inline constexpr char kScanGround[] = "ground_0";

// Returns the extensions of files that ReadMeshFile reads, such as ".obj".
std::vector<std::string_view> MeshExtensions();
bool IsMeshFile(const std::filesystem::path& file);

// Reads a file by its extension, in capitals or not. Throws ModelError, with the file and where
// known the line, for what is no such file, has no triangles, or is too large: 256 MiB, 4 million
// triangles, a corner more than 1e6 from the origin.
std::vector<MeshPart> ReadMeshFile(const std::filesystem::path& file);

// Wavefront OBJ: all objects of the file, polygons as fans, which is right for convex ones. Colours
// are Kd of the materials in its .mtl beside it, where that is there, or of its vertices.
std::vector<MeshPart> ReadObj(const std::filesystem::path& file);
// PLY, as text or binary. Colours of vertices are rounded to eighths, so that there are few parts.
std::vector<MeshPart> ReadPly(const std::filesystem::path& file);
// STL, as text or binary. It has no colours.
std::vector<MeshPart> ReadStl(const std::filesystem::path& file);

}  // namespace understudy::mjcf
