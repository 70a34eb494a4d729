// From MJCF in memory to a compiled model.
#ifndef UNDERSTUDY_MJCF_COMPILE_H_
#define UNDERSTUDY_MJCF_COMPILE_H_

#include <string>
#include <vector>

#include "mjcf/document.h"
#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {

// Throws ModelError with MuJoCo's message and the file and line of the element it is about, or only
// the root's file where MuJoCo names no line.
ModelHandle CompileMjcf(const MjcfElement& root);

// Every element and attribute that this MuJoCo does not know, one line each with file and line, in
// the order in which it refuses them. Empty where only something else is wrong, or nothing.
std::vector<std::string> UnknownWords(MjcfElement root);

}  // namespace understudy::mjcf

#endif  // UNDERSTUDY_MJCF_COMPILE_H_
