// From MJCF in memory to a compiled model.
#ifndef UNDERSTUDY_PHYSICS_MJCF_COMPILE_H_
#define UNDERSTUDY_PHYSICS_MJCF_COMPILE_H_

#include "physics/mjcf_document.h"
#include "physics/mujoco_handles.h"

namespace understudy {

// Throws ModelError with MuJoCo's message and the file and line of the element it is about, or only
// the root's file where MuJoCo names no line.
ModelHandle CompileMjcf(const MjcfElement& root);

}  // namespace understudy

#endif  // UNDERSTUDY_PHYSICS_MJCF_COMPILE_H_
