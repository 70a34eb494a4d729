#include "remote/pad_mapping.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "remote/remote_bits.h"

namespace understudy::remote {
namespace {

constexpr std::pair<PadButton, std::uint16_t> kButtons[] = {
    {PadButton::kA, RemoteBit("A")},
    {PadButton::kB, RemoteBit("B")},
    {PadButton::kX, RemoteBit("X")},
    {PadButton::kY, RemoteBit("Y")},
    {PadButton::kBack, RemoteBit("SELECT")},
    {PadButton::kStart, RemoteBit("START")},
    {PadButton::kLeftStick, RemoteBit("F1")},
    {PadButton::kRightStick, RemoteBit("F2")},
    {PadButton::kLeftShoulder, RemoteBit("L1")},
    {PadButton::kRightShoulder, RemoteBit("R1")},
    {PadButton::kUp, RemoteBit("UP")},
    {PadButton::kDown, RemoteBit("DOWN")},
    {PadButton::kLeft, RemoteBit("LEFT")},
    {PadButton::kRight, RemoteBit("RIGHT")},
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

robot::RemoteReading ReadPad(const PadState& pad, double dead_zone, std::uint16_t before) {
  unsigned keys = 0;
  for (const auto& [button, key] : kButtons) {
    if (pad.pressed[static_cast<std::size_t>(button)]) keys |= key;
  }
  keys |= TriggerKey(pad.left_trigger, RemoteBit("L2"), before);
  keys |= TriggerKey(pad.right_trigger, RemoteBit("R2"), before);
  const StickPlace left = BeyondDeadZone(pad.left_x, pad.left_y, dead_zone);
  const StickPlace right = BeyondDeadZone(pad.right_x, pad.right_y, dead_zone);
  // 0 - y, not -y: a stick in its middle is 0 and not -0.
  return {.there = true,
          .keys = static_cast<std::uint16_t>(keys),
          .lx = left.x,
          .ly = 0 - left.y,
          .rx = right.x,
          .ry = 0 - right.y};
}

}  // namespace understudy::remote
