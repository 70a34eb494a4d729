// Generates ground from the `scene` and `terrain` keys of a configuration.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "terrain/pieces.h"

namespace understudy::terrain {

// The scene that is a row of patches.
inline constexpr char kPatchesScene[] = "row";

// One patch of a row. Each field is a YAML key of the same name (config/terrain_keys.cc); a default
// value is replaced by that of TerrainSpec.
struct TerrainPatch {
  std::string kind = "flat";
  double difficulty = -1;  // 0..1; below 0: the spec's
  double friction = 0;     // 0: the spec's
  double length = 0;       // m along +x; 0: the spec's
  std::string image{};     // "": the spec's
};

// Where a user's scan stands, and what of it is touched. Each field is a YAML key of the same name.
struct ScanSpec {
  std::array<double, 3> pos{0, 0, 0};      // m, of the file's origin in the world
  std::array<double, 4> quat{1, 0, 0, 0};  // w, x, y, z
  double scale = 1;                        // m per unit of the file
  double height = 1;   // m, in the world, up to which its surfaces are touched; assumed
  double cell = 0.05;  // m, of the height field that is touched in its stead; assumed
};

// The parameters of a ground. Each field is a YAML key of the same name; docs/reference/terrain.md
// has the effect of difficulty on each kind.
struct TerrainSpec {
  double difficulty = 0.5;  // 0 nearly flat .. 1 the hardest; of a place, how much stands about
  double clutter = 0;       // 0..1: of a place, how much lies about that can be moved
  double friction = 0;      // of every contact with the ground; 0: the larger of 0.8 and the foot's
  std::array<double, 2> size = {8, 4};  // m: length of a patch along +x, width along y; assumed
  int seed = 1;                         // of the random parts
  std::string image;                    // PNG or PGM for kind image
  double image_height = 1;              // m from black to white at difficulty 1; assumed
  std::vector<TerrainPatch> patches;
  ScanSpec scan;
};

// Returns the names of the kinds of ground, in the order of the documentation.
const std::vector<std::string>& TerrainKinds();

// Returns all that WriteTerrain makes: the kinds of ground, the places, and kPatchesScene.
const std::vector<std::string>& GeneratedScenes();

// Returns whether `scene` is one of them.
bool IsTerrain(const std::string& scene);

// Returns what lies about in a place and can be moved, by difficulty, clutter and seed; nothing in
// other scenes. WriteTerrain leaves it out.
std::vector<LooseThing> LooseThings(const std::string& scene, const TerrainSpec& spec);

// Writes folder/scene.xml, plain MJCF, and two files per height field: terrain_N.hf, MuJoCo's
// binary format, which scene.xml uses, and terrain_N.png, 16-bit grey, for other programs. (MuJoCo
// reads only 8 bits of a PNG.) Equal arguments write equal bytes.
//
// A flat platform, 3 m long, with its top at z = 0 surrounds the world's origin. The patches follow
// along +x, each beginning at the height at which the one before ends, then a last platform of 2 m.
// Below is an endless floor. A place, such as an office, stands around the world's origin instead;
// of the spec it takes difficulty, friction and seed.
//
// Throws ModelError if `scene` is none of GeneratedScenes(), the row has no patch or more than 100,
// an image is missing or invalid, more than 4000 pieces are needed, or the folder cannot be
// written.
void WriteTerrain(const std::string& scene, const TerrainSpec& spec,
                  const std::filesystem::path& folder);

}  // namespace understudy::terrain
