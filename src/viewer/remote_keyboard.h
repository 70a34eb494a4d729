// Maps a window's keyboard to the remote controller, with the keys of `understudy remote`.
#pragma once

#include <map>

#include "robot/robot_values.h"

namespace understudy::viewer {

class RemoteKeyboard {
 public:
  // Take a GLFW key that was pressed or released; others than those of the remote are ignored. With
  // shift a stick deflects half.
  void Press(int key, bool shift = false) { down_[key] = shift; }
  void Release(int key) { down_.erase(key); }
  // Releases all keys, as when the window loses the focus.
  void ReleaseAll() { down_.clear(); }

  // Returns the remote's state for the pressed keys. Opposite directions of a stick cancel.
  robot::RemoteReading Read() const;

 private:
  std::map<int, bool> down_;  // with shift or without
};

}  // namespace understudy::viewer
