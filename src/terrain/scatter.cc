#include <algorithm>
#include <cmath>
#include <numbers>

#include "terrain/kinds.h"

namespace understudy::terrain {
namespace {

// Isaac Lab's grid of boxes has 0.45 m pitch; legged_gym's discrete obstacles reach 0.25 m
// (docs/reference/terrain.md). The rest is assumed.
constexpr double kStonePitch = 0.6;                         // m
constexpr double kGapByDifficulty = 0.4;                    // m, part of the pitch
constexpr double kStoneUnevenness = 0.05;                   // m up or down at difficulty 1
constexpr double kStonePit = 0.5;                           // m
constexpr double kBoxPitch = 0.45;                          // m
constexpr double kBoxHeight = 0.2;                          // m at difficulty 1
constexpr double kObstacleHeight = 0.25;                    // m at difficulty 1
constexpr double kObstaclesPerArea = 0.5;                   // 1/m²
constexpr double kObstacleFree = 0.6;                       // m at either end
constexpr double kObstacleSmall = 0.1, kObstacleBig = 0.4;  // m, half sides and radii

struct Cells {
  int columns, rows;
  double y;  // where the first row begins
};

// A grid of cells: as many as fit along x and as cover the width, with ground after the last.
Cells LayCells(const Stretch& s, double pitch, TerrainPieces* pieces) {
  constexpr double kRounding = 1e-9;
  const int columns = static_cast<int>(s.length / pitch + kRounding);
  const int rows = static_cast<int>(std::ceil(s.width / pitch - kRounding));
  pieces->AddGround(s.x + pitch * columns, s.x + s.length, -s.width / 2, s.width / 2, s.level,
                    s.friction);
  return {columns, rows, -pitch * rows / 2};
}

}  // namespace

double AddSteppingStones(const Stretch& s, TerrainPieces* pieces) {
  const double gap = OnHeightLattice(kGapByDifficulty * s.difficulty);
  if (gap == 0) return AddFlat(s, pieces);
  TerrainRandom random(s.seed);
  const Cells cells = LayCells(s, kStonePitch, pieces);
  const double half = (kStonePitch - gap) / 2;
  for (int i = 0; i < cells.columns; ++i) {
    for (int j = 0; j < cells.rows; ++j) {
      const double dx = random.Between(-gap / 4, gap / 4);
      const double dy = random.Between(-gap / 4, gap / 4);
      const double dz = kStoneUnevenness * s.difficulty * random.Between(-1, 1);
      pieces->Add({.x = s.x + kStonePitch * (i + 0.5) + dx,
                   .y = cells.y + kStonePitch * (j + 0.5) + dy,
                   .top = s.level + OnHeightLattice(dz),
                   .half_x = half,
                   .half_y = half,
                   .friction = s.friction});
    }
  }
  pieces->AddGround(s.x, s.x + s.length, -s.width / 2, s.width / 2, s.level - kStonePit,
                    s.friction);
  return s.level;
}

double AddBoxes(const Stretch& s, TerrainPieces* pieces) {
  if (s.difficulty == 0) return AddFlat(s, pieces);
  TerrainRandom random(s.seed);
  const Cells cells = LayCells(s, kBoxPitch, pieces);
  for (int i = 0; i < cells.columns; ++i) {
    for (int j = 0; j < cells.rows; ++j) {
      const double x = s.x + kBoxPitch * i;
      const double y = cells.y + kBoxPitch * j;
      const double height = kBoxHeight * s.difficulty * random.Between(0, 1);
      pieces->AddGround(x, x + kBoxPitch, y, y + kBoxPitch, s.level + OnHeightLattice(height),
                        s.friction);
    }
  }
  return s.level;
}

double AddObstacles(const Stretch& s, TerrainPieces* pieces) {
  AddFlat(s, pieces);
  if (s.difficulty == 0) return s.level;
  TerrainRandom random(s.seed);
  const int count = static_cast<int>(std::lround(kObstaclesPerArea * s.length * s.width));
  for (int i = 0; i < count; ++i) {
    TerrainPiece piece;
    piece.shape = random.Between(0, 1) < 0.5 ? PieceShape::kBox : PieceShape::kCylinder;
    piece.x = random.Between(s.x + kObstacleFree, s.x + s.length - kObstacleFree);
    piece.y = random.Between(-s.width / 2, s.width / 2);
    piece.half_x = random.Between(kObstacleSmall, kObstacleBig);
    piece.half_y = random.Between(kObstacleSmall, kObstacleBig);
    piece.yaw = random.Between(0, std::numbers::pi);
    piece.thickness = std::max(
        kHeightStep, OnHeightLattice(kObstacleHeight * s.difficulty * random.Between(0.2, 1)));
    piece.top = s.level + *piece.thickness;
    piece.friction = s.friction;
    pieces->Add(piece);
  }
  return s.level;
}

}  // namespace understudy::terrain
