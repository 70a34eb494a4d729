// Draws the remote controller with characters.
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

// Lines with their colours, from the top left of the screen, cut to `columns` and `rows`. What is
// pressed is shown inverse. Text that is not ASCII letters, digits and signs is shown as '?': the
// name of a gamepad is chosen by whoever made it.
std::string Draw(const RemotePicture& picture, int columns, int rows);

}  // namespace understudy::remote
