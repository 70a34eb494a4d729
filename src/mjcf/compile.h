// Compiles MJCF from memory.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mjcf/document.h"
#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {

// `warning`, which may be null, becomes what MuJoCo warns of, "" where it does not. Throws
// ModelError with MuJoCo's message. Both begin with file and line of the element they are about, or
// with the root's file only where MuJoCo names no line.
ModelHandle CompileMjcf(const MjcfElement& root, std::string* warning = nullptr);

// Every element and attribute that this MuJoCo does not know, one line each with file and line, in
// the order in which it refuses them. Empty where only something else is wrong, or nothing.
std::vector<std::string> UnknownWords(MjcfElement root);

// "13 bodies, 13 joints, 12 actuators", without the body of the world.
std::string CountsText(const mjModel& model);

// Version of the library that this program runs with, such as "2.2.2".
const char* MujocoVersion();

// As mj_saveModel writes it: only the same version of MuJoCo reads it. Throws ModelError.
std::string ModelBytes(const mjModel& model);

// Reads what mj_saveModel wrote. Throws ModelError when this MuJoCo cannot read it; `what` names it
// there.
ModelHandle ReadBinaryModel(std::string_view bytes, const std::string& what);

}  // namespace understudy::mjcf
