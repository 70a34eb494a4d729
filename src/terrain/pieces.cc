#include "terrain/pieces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"

namespace understudy::terrain {
namespace {

constexpr std::size_t kMostPieces = 4000;

}  // namespace

double OnHeightLattice(double z) { return std::round(z / kHeightStep) * kHeightStep; }

void TerrainPieces::AddGround(double x0, double x1, double y0, double y1, double top,
                              double friction) {
  if (x1 <= x0 || y1 <= y0) return;
  Add({.x = (x0 + x1) / 2,
       .y = (y0 + y1) / 2,
       .top = top,
       .half_x = (x1 - x0) / 2,
       .half_y = (y1 - y0) / 2,
       .friction = friction});
}

void TerrainPieces::Add(const TerrainPiece& piece) {
  if (pieces_.size() == kMostPieces) {
    throw ModelError("the terrain would need more than " + std::to_string(kMostPieces) +
                     " pieces; reduce terrain.size or the number of patches");
  }
  pieces_.push_back(piece);
  if (!piece.thickness) Lower(piece.top);
}

void TerrainPieces::AddHeights(double x, double y, double half_x, double half_y, double friction,
                               HeightGrid grid) {
  const auto [low, high] = std::minmax_element(grid.z.begin(), grid.z.end());
  if (*low == *high) {
    AddGround(x - half_x, x + half_x, y - half_y, y + half_y, *low, friction);
    return;
  }
  Lower(*low - kOverFloor);
  Add({.shape = PieceShape::kHeights,
       .x = x,
       .y = y,
       .top = OnHeightLattice(*high),
       .half_x = half_x,
       .half_y = half_y,
       .thickness = OnHeightLattice(*high - *low),
       .friction = friction,
       .heights = heights_.size()});
  heights_.push_back(std::move(grid));
}

void TerrainPieces::Lower(double z) { floor_ = std::min(floor_, z); }

std::vector<TerrainPiece> TerrainPieces::Pieces() const {
  std::vector<TerrainPiece> above;
  for (const TerrainPiece& piece : pieces_) {
    if (piece.top > floor_ + kHeightStep / 2) above.push_back(piece);
  }
  return above;
}

}  // namespace understudy::terrain
