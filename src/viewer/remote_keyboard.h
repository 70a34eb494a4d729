// The keyboard as the wireless remote, in a window, with the keys of `understudy remote`.
#ifndef UNDERSTUDY_VIEWER_REMOTE_KEYBOARD_H_
#define UNDERSTUDY_VIEWER_REMOTE_KEYBOARD_H_

#include <set>

#include "robot/robot_values.h"

namespace understudy {

class RemoteKeyboard {
 public:
  // A key of GLFW's that went down or up; what stands for nothing is left aside.
  void Press(int key) { down_.insert(key); }
  void Release(int key) { down_.erase(key); }
  // As when the window lost them.
  void ReleaseAll() { down_.clear(); }

  // What the keys that are down make of the remote controller. Opposite directions of a stick
  // cancel each other.
  RemoteReading Read() const;

 private:
  std::set<int> down_;
};

}  // namespace understudy

#endif  // UNDERSTUDY_VIEWER_REMOTE_KEYBOARD_H_
