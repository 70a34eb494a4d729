// Holds the state of the remote controller as requests set it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "robot/robot_values.h"

namespace understudy::robot {

inline constexpr double kForever = std::numeric_limits<double>::infinity();  // s

// A remote controller. It is off until the first use. Keys are bits (robot/remote_keys.h); times
// are simulated [s] and never go back. Allocates nothing.
class Remote {
 public:
  void Press(std::uint16_t keys, double until);
  void Hold(std::uint16_t keys) { Press(keys, kForever); }
  void Release(std::uint16_t keys) { Press(keys, 0); }
  // Sets one of lx, ly, rx, ry to `value` in [-1, 1]; it returns to 0 after `until`.
  void Move(std::size_t stick, double value, double until);
  // Sets all keys and sticks as in `reading`, and releases them after `until`. Ignores
  // `reading.there`: the remote is on.
  void Set(const RemoteReading& reading, double until);
  // As Set at time t, for a client that repeats what it holds and numbers its presses: keys that
  // time has released stay up until `press` is another number.
  void Renew(const RemoteReading& reading, std::int64_t press, double t, double until);
  // Switches it on or off. Off, keys and sticks are released and nothing is received.
  void Switch(bool on);

  // Returns its state at time t [s].
  const RemoteReading& Read(double t);

 private:
  struct Stick {
    double value = 0;
    double until = 0;  // s
  };

  std::array<double, 16> down_until_{};  // s, by key
  std::array<Stick, 4> sticks_{};        // lx, ly, rx, ry
  std::int64_t press_ = -1;              // of the last Renew
  std::uint16_t renewed_ = 0;            // its keys
  RemoteReading reading_;
};

}  // namespace understudy::robot
