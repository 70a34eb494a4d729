// Maps a terminal's keyboard to the remote controller (docs/reference/remote.md).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "remote/terminal_decoder.h"
#include "robot/remote_keys.h"
#include "robot/robot_values.h"

namespace understudy::remote {

// The effect of a key: a key of the remote, or the motion of a stick's axis.
struct KeyBinding {
  char32_t key;
  std::string_view shown;
  std::uint16_t remote_key;  // 0: an axis
  double robot::RemoteReading::*axis = nullptr;
  double to = 0;
};

// Letters are the remote's keys of that name; the keys of each stick are under one hand.
inline constexpr std::array<KeyBinding, 24> kKeyBindings = {{
    {U'q', "q", robot::RemoteBit("L1")},
    {U'w', "w", robot::RemoteBit("L2")},
    {U'p', "p", robot::RemoteBit("R1")},
    {U'o', "o", robot::RemoteBit("R2")},
    {U'a', "a", robot::RemoteBit("A")},
    {U'b', "b", robot::RemoteBit("B")},
    {U'x', "x", robot::RemoteBit("X")},
    {U'y', "y", robot::RemoteBit("Y")},
    {kUpKey, "up", robot::RemoteBit("UP")},
    {kDownKey, "down", robot::RemoteBit("DOWN")},
    {kLeftKey, "left", robot::RemoteBit("LEFT")},
    {kRightKey, "right", robot::RemoteBit("RIGHT")},
    {kEnterKey, "Enter", robot::RemoteBit("START")},
    {kTabKey, "Tab", robot::RemoteBit("SELECT")},
    {U'1', "1", robot::RemoteBit("F1")},
    {U'2', "2", robot::RemoteBit("F2")},
    {U'e', "e", 0, &robot::RemoteReading::ly, 1},
    {U'd', "d", 0, &robot::RemoteReading::ly, -1},
    {U's', "s", 0, &robot::RemoteReading::lx, -1},
    {U'f', "f", 0, &robot::RemoteReading::lx, 1},
    {U'i', "i", 0, &robot::RemoteReading::ry, 1},
    {U'k', "k", 0, &robot::RemoteReading::ry, -1},
    {U'j', "j", 0, &robot::RemoteReading::rx, -1},
    {U'l', "l", 0, &robot::RemoteReading::rx, 1},
}};

// A terminal does not report releases, so a key counts as released after this time [s] without a
// repeat: at first longer than the usual repeat delay of 0.25 to 0.66, then longer than the usual
// repeat period of 0.03 to 0.1. Both *assumed*.
inline constexpr double kFirstHeard = 0.7;
inline constexpr double kHeardAgain = 0.2;

// The keyboard's state. Times are of any steady clock [s].
class Keyboard {
 public:
  // Takes a pressed key. Ignores keys with Ctrl; Ctrl-C is a signal (RawTerminal).
  void Take(const TerminalKey& pressed, double t);
  robot::RemoteReading Read(double t) const;

  bool keeps_next() const { return keep_next_; }

 private:
  struct Key {
    double down_until = 0;
    bool kept = false;  // latched until released
    bool half = false;  // with shift: half deflection of a stick
  };

  void Press(Key* key, bool shift, double t);

  std::array<Key, kKeyBindings.size()> keys_{};
  bool keep_next_ = false;
};

}  // namespace understudy::remote
