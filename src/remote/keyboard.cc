#include "remote/keyboard.h"

#include <algorithm>

namespace understudy::remote {

void Keyboard::Press(Key* key, bool shift, double t) {
  key->half = shift;
  if (keep_next_) {
    keep_next_ = false;
    key->kept = !key->kept;
    if (!key->kept) key->down_until = 0;
    return;
  }
  key->down_until =
      std::max(key->down_until, t + (key->down_until > t ? kHeardAgain : kFirstHeard));
}

void Keyboard::Take(const TerminalKey& pressed, double t) {
  if (pressed.control) return;
  if (pressed.key == U' ') keep_next_ = !keep_next_;
  if (pressed.key == kEscapeKey) {
    keys_ = {};
    keep_next_ = false;
  }
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (kKeyBindings[i].key == pressed.key) Press(&keys_[i], pressed.shift, t);
  }
}

robot::RemoteReading Keyboard::Read(double t) const {
  robot::RemoteReading reading{.there = true};
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const KeyBinding& binding = kKeyBindings[i];
    if (!keys_[i].kept && keys_[i].down_until <= t) continue;
    reading.keys |= binding.remote_key;
    if (binding.axis != nullptr) reading.*binding.axis += binding.to * (keys_[i].half ? 0.5 : 1);
  }
  return reading;
}

}  // namespace understudy::remote
