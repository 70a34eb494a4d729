// Builds each kind of place: a world with walls and things around the start.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrain/pieces.h"

namespace understudy::terrain {

// The parameters of a place. `clutter` and `loose`, 0..1, say how much stands about, and how much
// lies about that can be moved.
struct PlaceSpec {
  double clutter = 0.5;
  double loose = 0;
  double friction = 0;  // as in TerrainPiece
  std::uint64_t seed = 0;
};

// A row: the name, the colour of the endless floor, and the law that adds the pieces. The law keeps
// 1.3 m along x and 0.7 m along y around the origin free.
struct PlaceKind {
  const char* name;
  const char* floor_colour;
  void (*add)(const PlaceSpec&, TerrainPieces*);
};

// Returns the row of that name, or null.
const PlaceKind* FindPlace(const std::string& name);

// Returns the names of all places, in the order of the documentation.
std::vector<std::string> PlaceNames();

}  // namespace understudy::terrain
