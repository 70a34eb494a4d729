// What AprilTags of the family 36h11 look like.
#pragma once

#include <vector>

namespace understudy::objects {

// Whether a cell is black, by row from the top and column from the left.
using CellGrid = std::vector<std::vector<bool>>;

inline constexpr int kAprilTags = 587;

// Returns the black square with the word in it, 8 by 8 cells. `id` is below kAprilTags.
CellGrid AprilTag(int id);

}  // namespace understudy::objects
