#include "terrain/terrain.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/errors.h"
#include "terrain/file.h"
#include "terrain/kinds.h"
#include "terrain/places.h"

namespace understudy::terrain {
namespace {

// A G1 that lies on its back needs 1.3 m; the other figures are assumed.
constexpr double kPlatform = 1.5;     // m before and behind the origin
constexpr double kPlatformWidth = 3;  // m at least
constexpr double kLastPlatform = 2;   // m
constexpr std::size_t kMostPatches = 100;

struct Kind {
  const char* name;
  double (*add)(const Stretch&, TerrainPieces*);
};

constexpr Kind kKinds[] = {
    {"flat", AddFlat},
    {"rough", AddRough},
    {"waves", AddWaves},
    {"slopes", AddSlopes},
    {"stairs_up", AddStairsUp},
    {"stairs_down", AddStairsDown},
    {"floating_stairs", AddFloatingStairs},
    {"gaps", AddGaps},
    {"stepping_stones", AddSteppingStones},
    {"boxes", AddBoxes},
    {"obstacles", AddObstacles},
    {"image", AddImage},
};

const Kind& FindKind(const std::string& name) {
  for (const Kind& kind : kKinds) {
    if (name == kind.name) return kind;
  }
  throw ModelError("no kind of terrain '" + name + "'");
}

// The splitmix64 of Sebastiano Vigna, applied to the seed and the patch's number: the patches are
// uncorrelated, and each is independent of the number and kind of the others.
std::uint64_t PatchSeed(int seed, std::size_t patch) {
  std::uint64_t z = (static_cast<std::uint64_t>(seed) << 32U) + patch + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

TerrainPieces Build(const std::vector<TerrainPatch>& patches, const TerrainSpec& spec) {
  TerrainPieces pieces;
  const double half_width = std::max(spec.size[1], kPlatformWidth) / 2;
  pieces.AddGround(-kPlatform, kPlatform, -half_width, half_width, 0, spec.friction);
  double x = kPlatform;
  double level = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const TerrainPatch& patch = patches[i];
    const Stretch stretch{.x = x,
                          .length = patch.length > 0 ? patch.length : spec.size[0],
                          .width = spec.size[1],
                          .level = level,
                          .difficulty = patch.difficulty >= 0 ? patch.difficulty : spec.difficulty,
                          .friction = patch.friction > 0 ? patch.friction : spec.friction,
                          .seed = PatchSeed(spec.seed, i),
                          .image = patch.image.empty() ? spec.image : patch.image,
                          .image_height = spec.image_height};
    // It is not the floor, which replaces ground of its height, if that rubs otherwise.
    if (stretch.friction != spec.friction) pieces.Lower(level - kOverFloor);
    level = OnHeightLattice(FindKind(patch.kind).add(stretch, &pieces));
    x += stretch.length;
  }
  pieces.AddGround(x, x + kLastPlatform, -half_width, half_width, level, spec.friction);
  return pieces;
}

TerrainPieces Furnish(const PlaceKind& place, const TerrainSpec& spec) {
  TerrainPieces pieces;
  pieces.PaintFloor(place.floor_colour);
  place.add({.clutter = spec.difficulty,
             .loose = spec.clutter,
             .friction = spec.friction,
             .seed = PatchSeed(spec.seed, 0)},
            &pieces);
  return pieces;
}

}  // namespace

const std::vector<std::string>& TerrainKinds() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const Kind& kind : kKinds) names.emplace_back(kind.name);
    return names;
  }();
  return kNames;
}

const std::vector<std::string>& GeneratedScenes() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names = TerrainKinds();
    for (std::string& place : PlaceNames()) names.push_back(std::move(place));
    names.emplace_back(kPatchesScene);
    return names;
  }();
  return kNames;
}

bool IsTerrain(const std::string& scene) {
  const std::vector<std::string>& scenes = GeneratedScenes();
  return std::find(scenes.begin(), scenes.end(), scene) != scenes.end();
}

std::vector<LooseThing> LooseThings(const std::string& scene, const TerrainSpec& spec) {
  const PlaceKind* const place = FindPlace(scene);
  if (place == nullptr) return {};
  return Furnish(*place, spec).loose();
}

void WriteTerrain(const std::string& scene, const TerrainSpec& spec,
                  const std::filesystem::path& folder) {
  if (const PlaceKind* const place = FindPlace(scene)) {
    WriteTerrainFiles(Furnish(*place, spec), scene, spec.friction, folder);
    return;
  }
  std::vector<TerrainPatch> patches = spec.patches;
  if (scene != kPatchesScene) {
    patches.assign(1, {});
    patches[0].kind = scene;
  } else if (patches.empty()) {
    throw ModelError("scene 'row' needs terrain.patches, such as [{kind: rough}, {kind: gaps}]");
  } else if (patches.size() > kMostPatches) {
    throw ModelError("terrain.patches has " + std::to_string(patches.size()) +
                     " patches; expected at most " + std::to_string(kMostPatches));
  }
  WriteTerrainFiles(Build(patches, spec), scene, spec.friction, folder);
}

}  // namespace understudy::terrain
