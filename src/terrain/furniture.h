// Puts up walls and furniture as pieces in the world frame.
#pragma once

#include <numbers>
#include <span>
#include <vector>

#include "terrain/pieces.h"

namespace understudy::terrain {

// Where a thing stands: its origin on the floor [m] and its turn about z [rad].
struct Spot {
  double x = 0, y = 0, yaw = 0;
};

inline constexpr double kQuarter = std::numbers::pi / 2;  // rad

// A box, or a cylinder of radius half_x, of a thing that stands in the origin and looks along +x
// [m].
struct Part {
  double x, y, half_x, half_y, bottom, top;
  const char* colour;
  PieceShape shape = PieceShape::kBox;
  bool solid = true;  // as in TerrainPiece
};

// Furniture (furniture.cc), of everyday sizes.
extern const std::span<const Part> kTable, kLowTable, kChair, kOfficeChair, kSofa, kBed, kDesk,
    kBookshelf, kWardrobe, kCounter, kFridge, kTelevision, kPlant, kLamp, kBath, kToilet, kBasin,
    kDoorLeaf, kRack, kPallet, kBollard, kStreetLamp, kTree, kCar, kBench, kBin, kHouse;

// A hole in a wall through which robots pass, around `at` [m] along the wall.
struct Opening {
  double at, width;
};

// A line on which a wall stands, along x or y from `from` to `to` [m], with its other coordinate.
struct WallLine {
  bool along_x;
  double from, to, across;
};

// Adds things to a place and knows where nothing stands.
class Furnisher {
 public:
  // Friction as in TerrainPiece.
  Furnisher(double friction, TerrainPieces* pieces) : friction_(friction), pieces_(pieces) {}

  void Put(std::span<const Part> parts, const Spot& spot);
  // A wall of that height and colour. Over each opening it begins at 2.1 m. At their ends, walls
  // along x reach past the lines of those along y, which end before them.
  void PutWall(const WallLine& line, double height, const char* colour,
               std::span<const Opening> openings = {});
  // Paint or cloth on the floor that is seen and not felt: a sheet around (x, y). Layers lie one
  // upon the other.
  void Paint(double x, double y, double half_x, double half_y, const char* colour, int layer = 1);
  // Ground on which things stand.
  void Pave(const Part& part);
  // Something loose, within that radius and of that height, where nothing is put from now on.
  void Lay(const LooseThing& thing, double radius, double height);
  // Something flat that hangs on a wall: seen and not felt.
  void Hang(const Part& part);
  // A plank that rises along `spot.yaw` by `rise` over `run`, of that half width, from its origin.
  void PutRamp(const Spot& spot, double run, double rise, double half_width, const char* colour);

  // Returns whether nothing that stands lower than `height` is nearer than `radius` [m] to (x, y),
  // and neither the start nor an opening is.
  bool IsFree(double x, double y, double radius, double height) const;

 private:
  void Add(TerrainPiece piece);

  double friction_;
  TerrainPieces* pieces_;
  std::vector<TerrainPiece> standing_;
  std::vector<Spot> openings_;
};

}  // namespace understudy::terrain
