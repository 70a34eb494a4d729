// Finds the topics of a hand among the links of its robot.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "robot/hand_law.h"
#include "robot/robot_spec.h"

namespace understudy::robot {

// Returns the indices of a hand's topics in `links`, which are named as on the wire: commands,
// states with their slow copies, and touch.
inline std::vector<std::size_t> HandLinks(const HandSpec& hand,
                                          const std::vector<std::string>& links) {
  std::vector<std::size_t> own;
  for (const char* word : {"cmd", "ctrl", "state", "touch"}) {
    const std::string topic = HandTopic(hand, word);
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (links[i] == topic || links[i] == "rt/lf" + topic.substr(2)) own.push_back(i);
    }
  }
  return own;
}

}  // namespace understudy::robot
