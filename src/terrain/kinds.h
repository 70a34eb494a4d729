// Builds each kind of ground.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "terrain/pieces.h"

namespace understudy::terrain {

// Random numbers that are the same on every machine: std::mt19937_64 is specified exactly; the
// standard's distributions, which are not, are not used.
class TerrainRandom {
 public:
  explicit TerrainRandom(std::uint64_t seed) : engine_(seed) {}

  // Returns a number in [low, high), in steps of (high - low) 2^-53.
  double Between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11U) * 0x1p-53);
  }

 private:
  std::mt19937_64 engine_;
};

// The area of a patch: x to x + length, |y| <= width / 2, beginning at height `level` [m]; and its
// parameters.
struct Stretch {
  double x = 0;
  double length = 0;
  double width = 0;
  double level = 0;
  double difficulty = 0;  // 0..1
  double friction = 0;
  std::uint64_t seed = 0;
  std::string image;
  double image_height = 0;  // m
};

// Each adds its ground and returns the height [m] at its end. docs/reference/terrain.md has the
// figures and their sources.

// Blocks (blocks.cc)
double AddFlat(const Stretch& s, TerrainPieces* pieces);
double AddSlopes(const Stretch& s, TerrainPieces* pieces);
double AddStairsUp(const Stretch& s, TerrainPieces* pieces);
double AddStairsDown(const Stretch& s, TerrainPieces* pieces);
double AddFloatingStairs(const Stretch& s, TerrainPieces* pieces);
double AddGaps(const Stretch& s, TerrainPieces* pieces);

// Scattered blocks (scatter.cc)
double AddSteppingStones(const Stretch& s, TerrainPieces* pieces);
double AddBoxes(const Stretch& s, TerrainPieces* pieces);
double AddObstacles(const Stretch& s, TerrainPieces* pieces);

// Height fields (heights.cc)
double AddRough(const Stretch& s, TerrainPieces* pieces);
double AddWaves(const Stretch& s, TerrainPieces* pieces);
// Throws ModelError if the image cannot be read.
double AddImage(const Stretch& s, TerrainPieces* pieces);

}  // namespace understudy::terrain
