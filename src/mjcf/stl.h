// Writes binary STL.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace understudy::mjcf {

// Returns a solid of triangles, nine numbers [m] each: three corners, counterclockwise from
// outside. It has no normals: readers compute them.
std::string Stl(std::span<const float> corners);

// The same as several solids, each with as many triangles as MuJoCo reads of one file.
std::vector<std::string> Stls(std::span<const float> corners);

}  // namespace understudy::mjcf
