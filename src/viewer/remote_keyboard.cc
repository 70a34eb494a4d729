#include "viewer/remote_keyboard.h"

#include <algorithm>

#include <GLFW/glfw3.h>

#include "remote/keyboard.h"

namespace understudy::viewer {
namespace {

// A key of the window as a terminal names it; 0 for what a terminal has no name for.
char32_t InTerminal(int key) {
  switch (key) {
    case GLFW_KEY_UP:
      return remote::kUpKey;
    case GLFW_KEY_DOWN:
      return remote::kDownKey;
    case GLFW_KEY_LEFT:
      return remote::kLeftKey;
    case GLFW_KEY_RIGHT:
      return remote::kRightKey;
    case GLFW_KEY_ENTER:
      return remote::kEnterKey;
    case GLFW_KEY_TAB:
      return remote::kTabKey;
    default:
      break;
  }
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return U'a' + static_cast<char32_t>(key - GLFW_KEY_A);
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return U'0' + static_cast<char32_t>(key - GLFW_KEY_0);
  return 0;
}

}  // namespace

robot::RemoteReading RemoteKeyboard::Read() const {
  robot::RemoteReading reading{.there = true};
  for (const auto& [key, half] : down_) {
    const auto* const binding =
        std::ranges::find(remote::kKeyBindings, InTerminal(key), &remote::KeyBinding::key);
    if (binding == remote::kKeyBindings.end()) continue;
    reading.keys |= binding->remote_key;
    if (binding->axis != nullptr) reading.*binding->axis += binding->to * (half ? 0.5 : 1);
  }
  return reading;
}

}  // namespace understudy::viewer
