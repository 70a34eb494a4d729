// The remote controller in somebody's hands.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "robot/robot_values.h"

namespace understudy::emulator {

inline constexpr double kForever = std::numeric_limits<double>::infinity();  // s

// Not there until it is used. Keys are bits, see robot/remote_keys.h; times are simulated [s] and
// never go back. Allocates nothing.
class Remote {
 public:
  void Press(std::uint16_t keys, double until);
  void Hold(std::uint16_t keys) { Press(keys, kForever); }
  void Release(std::uint16_t keys) { Press(keys, 0); }
  // One of lx, ly, rx, ry to -1..1, after `until` back to the middle.
  void Move(std::size_t stick, double value, double until);
  // Keys that are not in `reading` go up, sticks go where it says; after `until` all is let go.
  // `there` is left aside: it is.
  void Set(const robot::RemoteReading& reading, double until);
  // Off: keys and sticks are let go and nothing is received.
  void Switch(bool on);

  // What it sends at time t [s].
  const robot::RemoteReading& Read(double t);

 private:
  struct Stick {
    double value = 0;
    double until = 0;  // s
  };

  std::array<double, 16> down_until_{};  // s, by key
  std::array<Stick, 4> sticks_{};        // lx, ly, rx, ry
  robot::RemoteReading reading_;
};

}  // namespace understudy::emulator
