// Writes a compiled model as bytes.
#pragma once

#include <string>

#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {

// As mj_saveModel writes it: only the same version of MuJoCo reads it. Throws ModelError.
std::string ModelBytes(const mjModel& model);

}  // namespace understudy::mjcf
