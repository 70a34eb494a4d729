// The pieces of a terrain, before they are written.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace understudy::terrain {

enum class PieceShape { kBox, kCylinder, kHeights };

// A block with a top. World frame, m and rad.
struct TerrainPiece {
  PieceShape shape = PieceShape::kBox;
  double x = 0, y = 0, top = 0;                    // of the middle of the top
  double half_x = 0, half_y = 0;                   // of a cylinder half_x is the radius
  std::optional<double> thickness = std::nullopt;  // none: down to the floor
  double pitch = 0;  // about y, of a box with a thickness; positive goes down
  double yaw = 0;    // about z
  double friction = 0;
  std::size_t heights = 0;  // index in TerrainPieces::heights, of kHeights
};

// Heights over a rectangle, from -x to +x and row after row from -y to +y; those at its edges
// belong to it.
struct HeightGrid {
  int rows = 0, columns = 0;
  std::vector<float> z;  // m, rows · columns
};

// The whole ground, piece by piece.
class TerrainPieces {
 public:
  // Flat ground from x0 to x1 and from y0 to y1.
  void AddGround(double x0, double x1, double y0, double y1, double top, double friction);
  void Add(const TerrainPiece& piece);
  // A height field over the rectangle around (x, y); ground where all heights are equal.
  void AddHeights(double x, double y, double half_x, double half_y, double friction,
                  HeightGrid grid);
  // The floor is to be no higher than z.
  void Lower(double z);

  // What is to be written: pieces above the floor. The floor serves as the others.
  std::vector<TerrainPiece> Pieces() const;
  const std::vector<HeightGrid>& heights() const { return heights_; }
  double floor() const { return floor_; }

 private:
  std::vector<TerrainPiece> pieces_;
  std::vector<HeightGrid> heights_;
  double floor_ = 0;
};

// Heights are whole multiples of this [m], so that the last bits of a sine do not matter.
inline constexpr double kHeightStep = 1e-4;
double OnHeightLattice(double z);

}  // namespace understudy::terrain
