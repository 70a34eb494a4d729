// Collects the pieces of a terrain: blocks and height fields.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace understudy::terrain {

enum class PieceShape { kBox, kCylinder, kHeights, kSheet };

// A block, a height field or a sheet, given by its top surface, in the world frame.
struct TerrainPiece {
  PieceShape shape = PieceShape::kBox;
  double x = 0, y = 0, top = 0;                    // m, centre of the top
  double half_x = 0, half_y = 0;                   // m; half_x is the radius of a cylinder
  std::optional<double> thickness = std::nullopt;  // m; nullopt: down to the floor
  double pitch = 0;  // rad about y, for a box with a thickness; positive descends
  double yaw = 0;    // rad about z, after the pitch
  double friction = 0;
  std::size_t heights = 0;       // index in TerrainPieces::heights, of kHeights
  const char* colour = nullptr;  // red, green, blue, opacity from 0 to 1; null: one of the ground's
  bool solid = true;             // else it is seen, and nothing touches it
};

// Heights on a grid over a rectangle, including its edges: rows from -y to +y, each from -x to +x.
struct HeightGrid {
  int rows = 0, columns = 0;
  std::vector<float> z;  // m, rows · columns
};

// Something that lies about and can be moved: an object of that kind (objects/object_kinds.h) with
// the middle of its underside there [m], and its turn about z [rad].
struct LooseThing {
  const char* kind;
  double x, y, z, yaw;
};

// All pieces of a ground, and the height of its floor.
class TerrainPieces {
 public:
  // Adds flat ground from x0 to x1 and from y0 to y1 at height `top`.
  void AddGround(double x0, double x1, double y0, double y1, double top, double friction);
  void Add(const TerrainPiece& piece);
  // Adds a height field over the rectangle around (x, y); flat ground if all heights are equal.
  void AddHeights(double x, double y, double half_x, double half_y, double friction,
                  HeightGrid grid);
  // Gives the floor a colour, as that of a piece.
  void PaintFloor(const char* colour) { floor_colour_ = colour; }
  void AddLoose(const LooseThing& thing) { loose_.push_back(thing); }
  // Lowers the floor to z if it is higher.
  void Lower(double z);

  // Returns the pieces to write, without those at the height of the floor, which replaces them.
  std::vector<TerrainPiece> Pieces() const;
  const std::vector<HeightGrid>& heights() const { return heights_; }
  const std::vector<LooseThing>& loose() const { return loose_; }
  double floor() const { return floor_; }
  const char* floor_colour() const { return floor_colour_; }  // null: as in models/scene/flat.xml

 private:
  std::vector<TerrainPiece> pieces_;
  std::vector<HeightGrid> heights_;
  std::vector<LooseThing> loose_;
  double floor_ = 0;
  const char* floor_colour_ = nullptr;
};

// The least distance [m] above the floor of what must not touch it too, as a height field;
// *assumed*.
inline constexpr double kOverFloor = 0.05;

// Step [m] of the lattice of heights, so that rounding errors of sines do not matter.
inline constexpr double kHeightStep = 1e-4;
double OnHeightLattice(double z);

}  // namespace understudy::terrain
