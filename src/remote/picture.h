// Draws the remote controller as text.
#pragma once

#include <string>
#include <vector>

#include "robot/robot_values.h"

namespace understudy::remote {

struct RemotePicture {
  robot::RemoteReading reading{};
  std::string title{};
  std::vector<std::string> notes{};  // below
};

// Returns coloured lines for the screen, clipped to `columns` and `rows`. Pressed keys are inverse.
// Other characters than ASCII letters, digits and signs become '?', since a gamepad's name may
// contain any.
std::string Draw(const RemotePicture& picture, int columns, int rows);

}  // namespace understudy::remote
