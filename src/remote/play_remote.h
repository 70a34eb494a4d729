// Runs `understudy remote`: sends keyboard and gamepad to the robot until Ctrl-C.
#pragma once

#include "remote/arguments.h"

namespace understudy::remote {

// Throws SetupError: there is no such robot, or it has gone. Where there is neither a terminal nor
// a gamepad it waits for the latter.
void PlayRemote(const RemoteArguments& arguments);

}  // namespace understudy::remote
