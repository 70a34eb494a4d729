// Writes a compiled model as MJCF for other programs that have MuJoCo, 2 or 3.
#pragma once

#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {

// A file that the MJCF names, beside it.
struct SavedField {
  std::string file;
  std::string bytes;  // as MuJoCo reads a height field
};

struct SavedModel {
  std::string xml;
  std::vector<SavedField> fields;  // of the ground
};

// Returns what `model` is: bodies, joints, figures, contacts. Its actuators work, and it lacks what
// only Understudy needs of it: `clamp`, the name of a weld, and room for contacts. Numbers have six
// digits. `model` is the last one that this process has compiled; its numbers may have changed
// since. Throws ModelError.
SavedModel SaveModel(const mjModel& model, const std::string& clamp);

}  // namespace understudy::mjcf
