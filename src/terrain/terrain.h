// Makes ground from a few numbers: those of a run's `scene` and `terrain` keys.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace understudy::terrain {

// The word that means "the patches, one after the other"; every other word is a kind.
inline constexpr char kPatchesScene[] = "row";

// One stretch of ground in a row. Every field is a YAML key of the same name (config/keys.cc); a
// value that is left as it stands here is taken from TerrainSpec.
struct TerrainPatch {
  std::string kind = "flat";
  double difficulty = -1;  // 0..1; below 0: the spec's
  double friction = 0;     // 0: the spec's
  double length = 0;       // m along +x; 0: the spec's
  std::string image{};     // "": the spec's
};

// Every field is a YAML key of the same name; what each kind makes of difficulty is in
// docs/terrain.md.
struct TerrainSpec {
  double difficulty = 0.5;  // 0 nearly flat .. 1 the hardest
  double friction = 0;  // of every contact with the ground; 0: the larger of 0.8 and the foot's own
  std::array<double, 2> size = {8, 4};  // m: length of a patch along +x, width along y; assumed
  int seed = 1;                         // of everything random
  std::string image;                    // PNG or PGM of kind image
  double image_height = 1;              // m from black to white at difficulty 1; assumed
  std::vector<TerrainPatch> patches;
};

// The words a patch's kind may be, in the order of the documentation.
const std::vector<std::string>& TerrainKinds();

// Whether `scene` is made here: a kind or kPatchesScene.
bool IsTerrain(const std::string& scene);

// Writes folder/scene.xml, plain MJCF, and beside it for each height field its heights twice:
// terrain_N.hf, MuJoCo's own binary format, which scene.xml names, and terrain_N.png, 16 bit grey,
// for other programs. (MuJoCo reads 8 bits of a PNG only.) Equal arguments write equal bytes.
//
// The world frame has a flat platform around its origin, 3 m long, whose top is z = 0. The patches
// follow along +x, each beginning at the height where the one before it ends, and a last platform
// of 2 m. They lie over an endless floor.
//
// Throws ModelError when `scene` is neither kind nor row, the row has no patch or more than 100,
// an image is missing or no image, more than 4000 pieces would be needed, or the folder cannot be
// written.
void WriteTerrain(const std::string& scene, const TerrainSpec& spec,
                  const std::filesystem::path& folder);

}  // namespace understudy::terrain
