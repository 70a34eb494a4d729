#include "remote/keyboard.h"

#include <algorithm>
#include <limits>

namespace understudy::remote {
namespace {

using Kind = TerminalEvent::Kind;

constexpr double kForever = std::numeric_limits<double>::infinity();

}  // namespace

void Keyboard::Press(Key* key, const TerminalEvent& event, double t) {
  key->half = event.shift;
  if (keep_next_ && event.kind == Kind::kPress) {
    keep_next_ = false;
    key->kept = !key->kept;
    if (!key->kept) key->down_until = 0;
    return;
  }
  if (key->down_until <= t) key->pressed_at = t;
  const double more = key->down_until > t ? kHeardAgain : kFirstHeard;
  key->down_until = reports_releases_ ? kForever : std::max(key->down_until, t + more);
}

void Keyboard::Release() {
  for (Key& key : keys_) key.down_until = 0;
}

void Keyboard::Take(const TerminalEvent& event, double t) {
  if (event.kind == Kind::kFocusLost) return Release();
  if (event.kind == Kind::kReportsReleases) {
    reports_releases_ = true;
    return;
  }
  const bool pressed = event.kind == Kind::kPress;
  if (event.control) {
    if (event.key == U'c' && pressed) wants_to_quit_ = true;
    return;
  }
  if (event.key == U' ' && pressed) keep_next_ = !keep_next_;
  if (event.key == kEscapeKey && pressed) {
    keys_ = {};
    keep_next_ = false;
  }
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (kKeyBindings[i].key != event.key) continue;
    if (event.kind == Kind::kRelease) {
      const double least = keys_[i].pressed_at + kShortestPress;
      keys_[i].down_until = std::min(keys_[i].down_until, std::max(t, least));
    } else {
      Press(&keys_[i], event, t);
    }
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
