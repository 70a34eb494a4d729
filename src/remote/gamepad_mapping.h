// Maps the buttons and axes of a gamepad to those of the remote controller
// (docs/reference/remote.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "robot/robot_values.h"

namespace understudy::remote {

// Buttons by their labels, in SDL's order. On a PlayStation's gamepad A, B, X, Y are cross, circle,
// square, triangle.
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

// Dead zone of a stick around its middle; the output starts at 0 at its edge. *Assumed*, enough for
// worn sticks.
inline constexpr double kDeadZone = 0.1;
// A trigger is a key with hysteresis: down above the first threshold, up below the second.
// *Assumed*.
inline constexpr double kTriggerDown = 0.5;
inline constexpr double kTriggerUp = 0.4;

// `before` has the keys of the previous reading. `dead_zone` is in [0, 1).
robot::RemoteReading ReadGamepad(const GamepadState& gamepad, double dead_zone,
                                 std::uint16_t before);

}  // namespace understudy::remote
