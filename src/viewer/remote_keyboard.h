// The keyboard of a window as the remote controller, with the keys of `understudy remote`.
#pragma once

#include <map>

#include "robot/robot_values.h"

namespace understudy::viewer {

class RemoteKeyboard {
 public:
  // A key of GLFW's that went down or up; what stands for nothing is left aside. With shift a stick
  // goes half the way.
  void Press(int key, bool shift = false) { down_[key] = shift; }
  void Release(int key) { down_.erase(key); }
  // As when the window lost them.
  void ReleaseAll() { down_.clear(); }

  // What the keys that are down make of the remote controller. Opposite directions of a stick
  // cancel each other.
  robot::RemoteReading Read() const;

 private:
  std::map<int, bool> down_;  // with shift or without
};

}  // namespace understudy::viewer
