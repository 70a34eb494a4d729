#include "viewer/remote_keyboard.h"

#include <array>
#include <string_view>

#include <GLFW/glfw3.h>

#include "robot/remote_keys.h"

namespace understudy {
namespace {

struct KeyRow {
  int key;
  std::string_view name;  // of a key of the remote controller
};

constexpr std::array<KeyRow, 16> kKeys = {{{GLFW_KEY_Q, "L1"},
                                           {GLFW_KEY_W, "L2"},
                                           {GLFW_KEY_P, "R1"},
                                           {GLFW_KEY_O, "R2"},
                                           {GLFW_KEY_A, "A"},
                                           {GLFW_KEY_B, "B"},
                                           {GLFW_KEY_X, "X"},
                                           {GLFW_KEY_Y, "Y"},
                                           {GLFW_KEY_UP, "UP"},
                                           {GLFW_KEY_DOWN, "DOWN"},
                                           {GLFW_KEY_LEFT, "LEFT"},
                                           {GLFW_KEY_RIGHT, "RIGHT"},
                                           {GLFW_KEY_ENTER, "START"},
                                           {GLFW_KEY_TAB, "SELECT"},
                                           {GLFW_KEY_1, "F1"},
                                           {GLFW_KEY_2, "F2"}}};

struct StickRow {
  int key;
  double RemoteReading::*axis;
  double by;
};

constexpr std::array<StickRow, 8> kSticks = {{{GLFW_KEY_E, &RemoteReading::ly, 1},
                                              {GLFW_KEY_D, &RemoteReading::ly, -1},
                                              {GLFW_KEY_S, &RemoteReading::lx, -1},
                                              {GLFW_KEY_F, &RemoteReading::lx, 1},
                                              {GLFW_KEY_I, &RemoteReading::ry, 1},
                                              {GLFW_KEY_K, &RemoteReading::ry, -1},
                                              {GLFW_KEY_J, &RemoteReading::rx, -1},
                                              {GLFW_KEY_L, &RemoteReading::rx, 1}}};

}  // namespace

RemoteReading RemoteKeyboard::Read() const {
  RemoteReading reading{.there = true};
  for (const KeyRow& row : kKeys) {
    if (down_.contains(row.key)) {
      reading.keys = static_cast<std::uint16_t>(reading.keys | *RemoteKeys(row.name));
    }
  }
  for (const StickRow& row : kSticks) {
    if (down_.contains(row.key)) reading.*row.axis += row.by;
  }
  return reading;
}

}  // namespace understudy
