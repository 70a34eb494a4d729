#include "robot/remote.h"

#include <algorithm>

namespace understudy::robot {
namespace {

bool Has(std::uint16_t keys, std::size_t key) { return (keys >> key & 1U) != 0; }

}  // namespace

void Remote::Press(std::uint16_t keys, double until) {
  reading_.there = true;
  for (std::size_t key = 0; key < down_until_.size(); ++key) {
    if (Has(keys, key)) down_until_[key] = until;
  }
}

void Remote::Move(std::size_t stick, double value, double until) {
  reading_.there = true;
  sticks_[stick] = {.value = std::clamp(value, -1.0, 1.0), .until = until};
}

void Remote::Set(const RemoteReading& reading, double until) {
  Release(0xFFFF);
  Press(reading.keys, until);
  const double values[] = {reading.lx, reading.ly, reading.rx, reading.ry};
  for (std::size_t i = 0; i < sticks_.size(); ++i) Move(i, values[i], until);
}

void Remote::Renew(const RemoteReading& reading, std::int64_t press, double t, double until) {
  unsigned lapsed = 0;
  for (std::size_t key = 0; press == press_ && key < down_until_.size(); ++key) {
    if (Has(renewed_, key) && down_until_[key] <= t) lapsed |= 1U << key;
  }
  press_ = press;
  renewed_ = reading.keys;
  RemoteReading held = reading;
  held.keys = static_cast<std::uint16_t>(reading.keys & ~lapsed);
  Set(held, until);
}

void Remote::Switch(bool on) {
  if (!on) *this = Remote();
  reading_.there = on;
}

const RemoteReading& Remote::Read(double t) {
  if (!reading_.there) return reading_;
  unsigned keys = 0;
  for (std::size_t key = 0; key < down_until_.size(); ++key) {
    if (down_until_[key] > t) keys |= 1U << key;
  }
  reading_.keys = static_cast<std::uint16_t>(keys);
  const auto value = [&](const Stick& stick) { return stick.until > t ? stick.value : 0; };
  reading_.lx = value(sticks_[0]);
  reading_.ly = value(sticks_[1]);
  reading_.rx = value(sticks_[2]);
  reading_.ry = value(sticks_[3]);
  return reading_;
}

}  // namespace understudy::robot
