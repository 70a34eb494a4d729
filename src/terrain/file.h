// Writes a terrain's pieces to files.
#pragma once

#include <filesystem>
#include <string>

#include "terrain/pieces.h"

namespace understudy::terrain {

// Writes scene.xml and the height fields as described at WriteTerrain. `floor_friction` is that of
// the endless floor. Creates the folder. Throws ModelError if a file cannot be written.
void WriteTerrainFiles(const TerrainPieces& pieces, const std::string& name, double floor_friction,
                       const std::filesystem::path& folder);

// Writes sight.xml: the same with `assets` and `geoms` of MJCF in place of the pieces.
void WriteSightFile(const TerrainPieces& pieces, const std::string& name, const std::string& assets,
                    const std::string& geoms, const std::filesystem::path& folder);

// Throws ModelError.
void WriteBytes(const std::filesystem::path& file, const std::string& bytes);

}  // namespace understudy::terrain
