#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/errors.h"
#include "terrain/image.h"
#include "terrain/kinds.h"

namespace understudy::terrain {
namespace {

// The height fields of Isaac Lab and legged_gym have 0.1 m cells (docs/reference/terrain.md). The
// other figures are assumed.
constexpr double kCell = 0.1;                       // m
constexpr double kRoughness = 0.1;                  // m up and down at difficulty 1
constexpr double kScales[] = {1.6, 0.8, 0.4, 0.2};  // m, of the noise; each half as strong
constexpr double kTaper = 0.5;                      // m from level ground to full roughness
constexpr double kWaveHeight = 0.15;                // m up and down at difficulty 1
constexpr double kWaveLength = 2;                   // m, about: a whole number of waves fits

HeightGrid GridOver(const Stretch& s) {
  HeightGrid grid;
  grid.columns = static_cast<int>(std::lround(s.length / kCell)) + 1;
  grid.rows = static_cast<int>(std::lround(s.width / kCell)) + 1;
  grid.z.resize(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns));
  return grid;
}

// Makes a grid of height(column, row), rounded to the lattice.
template <class F>
void Fill(HeightGrid* grid, F height) {
  std::size_t i = 0;
  for (int row = 0; row < grid->rows; ++row) {
    for (int column = 0; column < grid->columns; ++column) {
      grid->z[i++] = static_cast<float>(OnHeightLattice(height(column, row)));
    }
  }
}

double AddGrid(const Stretch& s, HeightGrid grid, TerrainPieces* pieces) {
  pieces->AddHeights(s.x + s.length / 2, 0, s.length / 2, s.width / 2, s.friction, std::move(grid));
  return s.level;
}

// Adds smooth noise between -strength and strength with knots `every` cells apart.
void AddNoise(const HeightGrid& grid, int every, double strength, TerrainRandom* random,
              std::vector<double>* noise) {
  const int columns = (grid.columns - 1) / every + 2;
  const int rows = (grid.rows - 1) / every + 2;
  std::vector<double> knots(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (double& knot : knots) knot = random->Between(-strength, strength);
  const auto knot = [&](int column, int row) {
    return knots[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(column)];
  };
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  std::size_t i = 0;
  for (int row = 0; row < grid.rows; ++row) {
    const int r = row / every;
    const double v = smooth(static_cast<double>(row % every) / every);
    for (int column = 0; column < grid.columns; ++column) {
      const int c = column / every;
      const double u = smooth(static_cast<double>(column % every) / every);
      (*noise)[i++] += (1 - v) * ((1 - u) * knot(c, r) + u * knot(c + 1, r)) +
                       v * ((1 - u) * knot(c, r + 1) + u * knot(c + 1, r + 1));
    }
  }
}

}  // namespace

double AddRough(const Stretch& s, TerrainPieces* pieces) {
  HeightGrid grid = GridOver(s);
  TerrainRandom random(s.seed);
  std::vector<double> noise(grid.z.size(), 0.0);
  double strength = 1;
  for (const double scale : kScales) {
    AddNoise(grid, static_cast<int>(std::lround(scale / kCell)), strength, &random, &noise);
    strength /= 2;
  }
  double most = 0;
  for (const double z : noise) most = std::max(most, std::abs(z));
  const double cell = s.length / (grid.columns - 1);
  Fill(&grid, [&](int column, int row) {
    const double edge = cell * std::min(column, grid.columns - 1 - column);
    const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                   static_cast<std::size_t>(column);
    return s.level + kRoughness * s.difficulty * std::min(1.0, edge / kTaper) * noise[i] / most;
  });
  return AddGrid(s, std::move(grid), pieces);
}

double AddWaves(const Stretch& s, TerrainPieces* pieces) {
  HeightGrid grid = GridOver(s);
  const double waves = std::max(1.0, std::round(s.length / kWaveLength));
  Fill(&grid, [&](int column, int) {
    const double phase = 2 * std::numbers::pi * waves * column / (grid.columns - 1);
    return s.level + kWaveHeight * s.difficulty * std::sin(phase);
  });
  return AddGrid(s, std::move(grid), pieces);
}

double AddImage(const Stretch& s, TerrainPieces* pieces) {
  if (s.image.empty()) {
    throw ModelError("a terrain of kind image needs terrain.image, the path of a PNG or PGM");
  }
  const GreyImage image = ReadGreyImage(s.image);
  HeightGrid grid;
  grid.columns = image.width;
  grid.rows = image.height;
  grid.z.resize(image.grey.size());
  Fill(&grid, [&](int column, int row) {
    const auto i =
        static_cast<std::size_t>(image.height - 1 - row) * static_cast<std::size_t>(image.width) +
        static_cast<std::size_t>(column);
    return s.level + s.image_height * s.difficulty * image.grey[i];
  });
  return AddGrid(s, std::move(grid), pieces);
}

}  // namespace understudy::terrain
