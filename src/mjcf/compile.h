// Compiles MJCF from memory.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mjcf/document.h"
#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {

// Compiles MJCF. Sets `warning`, which may be null, to MuJoCo's warning, "" for none. Throws
// ModelError with MuJoCo's message. Both begin with file and line of the element, or only with the
// root's file if MuJoCo names no line.
ModelHandle CompileMjcf(const MjcfElement& root, std::string* warning = nullptr);

// Returns all elements and attributes that this MuJoCo does not know, one line each with file and
// line, in the order in which it refuses them. Empty if there are none.
std::vector<std::string> UnknownWords(MjcfElement root);

// Returns "13 bodies, 13 joints, 12 actuators", without the world body.
std::string CountsText(const mjModel& model);

// Returns what a <mesh> has to say that is a sheet without a volume, such as a wall.
const char* SheetAttribute();

// Returns the version of the loaded library, such as "2.2.2".
const char* MujocoVersion();

// Returns the bytes of mj_saveModel, which only the same version of MuJoCo can read. Throws
// ModelError.
std::string ModelBytes(const mjModel& model);

// Reads the bytes of mj_saveModel. Throws ModelError, beginning with `what`, if this MuJoCo cannot
// read them.
ModelHandle ReadBinaryModel(std::string_view bytes, const std::string& what);

}  // namespace understudy::mjcf
