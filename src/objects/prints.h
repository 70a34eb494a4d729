// What is printed on the front of objects.
#pragma once

#include <array>
#include <vector>

#include "objects/object_kinds.h"

namespace understudy::objects {

// A black rectangle on the front, which looks along +x; `y` is to the right of who looks at it.
struct Print {
  std::array<double, 2> at;    // m: y, z of its middle, from the middle of the object's underside
  std::array<double, 2> half;  // m: half sides along y and z
};

// Returns what is printed on it: rectangles that overlap where they meet, so that none is seen
// through between them. A cell that is black belongs to one along its row and one along its column.
std::vector<Print> PrintsOf(const ObjectSpec& object);

}  // namespace understudy::objects
