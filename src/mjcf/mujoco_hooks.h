// Catches MuJoCo's errors and warnings.
#pragma once

#include <string_view>

namespace understudy::mjcf {

// From the first call on an error of MuJoCo throws ModelError, and each thread keeps the last
// warning of its own calls. Without it the library waits for Enter on the terminal and writes
// MUJOCO_LOG.TXT. Call it before loading a model.
void InstallMujocoHooks();

// The last warning in this thread since the last call, at most 511 characters; "" where there was
// none. Valid until MuJoCo next warns in this thread. Takes no lock and allocates nothing.
std::string_view TakeMujocoWarning();

}  // namespace understudy::mjcf
