#include "remote/gamepad_mapping.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "robot/remote_keys.h"

namespace understudy::remote {
namespace {

constexpr std::pair<GamepadButton, std::uint16_t> kButtons[] = {
    {GamepadButton::kA, robot::RemoteBit("A")},
    {GamepadButton::kB, robot::RemoteBit("B")},
    {GamepadButton::kX, robot::RemoteBit("X")},
    {GamepadButton::kY, robot::RemoteBit("Y")},
    {GamepadButton::kBack, robot::RemoteBit("SELECT")},
    {GamepadButton::kStart, robot::RemoteBit("START")},
    {GamepadButton::kLeftStick, robot::RemoteBit("F1")},
    {GamepadButton::kRightStick, robot::RemoteBit("F2")},
    {GamepadButton::kLeftShoulder, robot::RemoteBit("L1")},
    {GamepadButton::kRightShoulder, robot::RemoteBit("R1")},
    {GamepadButton::kUp, robot::RemoteBit("UP")},
    {GamepadButton::kDown, robot::RemoteBit("DOWN")},
    {GamepadButton::kLeft, robot::RemoteBit("LEFT")},
    {GamepadButton::kRight, robot::RemoteBit("RIGHT")},
};

struct StickPlace {
  double x, y;
};

// Round, so that a direction stays that direction; full deflection stays full.
StickPlace BeyondDeadZone(double x, double y, double dead_zone) {
  const double length = std::hypot(x, y);
  if (!(length > dead_zone)) return {0, 0};
  const double scale = (length - dead_zone) / (1 - dead_zone) / length;
  return {std::clamp(x * scale, -1.0, 1.0), std::clamp(y * scale, -1.0, 1.0)};
}

std::uint16_t TriggerKey(double trigger, std::uint16_t key, std::uint16_t before) {
  return trigger > ((before & key) != 0 ? kTriggerUp : kTriggerDown) ? key : std::uint16_t{0};
}

}  // namespace

robot::RemoteReading ReadGamepad(const GamepadState& gamepad, double dead_zone,
                                 std::uint16_t before) {
  unsigned keys = 0;
  for (const auto& [button, key] : kButtons) {
    if (gamepad.pressed[static_cast<std::size_t>(button)]) keys |= key;
  }
  keys |= TriggerKey(gamepad.left_trigger, robot::RemoteBit("L2"), before);
  keys |= TriggerKey(gamepad.right_trigger, robot::RemoteBit("R2"), before);
  const StickPlace left = BeyondDeadZone(gamepad.left_x, gamepad.left_y, dead_zone);
  const StickPlace right = BeyondDeadZone(gamepad.right_x, gamepad.right_y, dead_zone);
  // 0 - y, not -y: a stick in its middle is 0 and not -0.
  return {.there = true,
          .keys = static_cast<std::uint16_t>(keys),
          .lx = left.x,
          .ly = 0 - left.y,
          .rx = right.x,
          .ry = 0 - right.y};
}

}  // namespace understudy::remote
