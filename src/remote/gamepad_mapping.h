// Maps the buttons and axes of a gamepad to those of the remote controller (docs/remote.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "robot/robot_values.h"

namespace understudy::remote {

// Buttons by what is written on them, in SDL's order. On a PlayStation's A, B, X, Y are cross,
// circle, square, triangle.
enum class GamepadButton : std::uint8_t {
  kA,
  kB,
  kX,
  kY,
  kBack,
  kGuide,
  kStart,
  kLeftStick,
  kRightStick,
  kLeftShoulder,
  kRightShoulder,
  kUp,
  kDown,
  kLeft,
  kRight,
};
inline constexpr std::size_t kGamepadButtons = 15;

struct GamepadState {
  std::array<bool, kGamepadButtons> pressed{};
  double left_x = 0, left_y = 0;               // -1..1, positive right and down
  double right_x = 0, right_y = 0;             // the same
  double left_trigger = 0, right_trigger = 0;  // 0..1
};

// A stick within this of its middle is in its middle; beyond, it begins at 0; *assumed*, what worn
// sticks want.
inline constexpr double kDeadZone = 0.1;
// A trigger is a key that goes down above the one and up below the other, so that it does not
// flicker between; *assumed*.
inline constexpr double kTriggerDown = 0.5;
inline constexpr double kTriggerUp = 0.4;

// `before`: the keys of the reading before this one. `dead_zone` is 0 to below 1.
robot::RemoteReading ReadGamepad(const GamepadState& gamepad, double dead_zone,
                                 std::uint16_t before);

}  // namespace understudy::remote
