#include "emulator/remote.h"

#include <algorithm>
#include <limits>

namespace understudy::emulator {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

bool Has(std::uint16_t keys, std::size_t key) { return (keys >> key & 1U) != 0; }

}  // namespace

void Remote::Press(const PressRemote& order, double t) {
  reading_.there = true;
  for (std::size_t key = 0; key < down_until_.size(); ++key) {
    if (Has(order.keys, key)) down_until_[key] = t + order.seconds;
  }
}

void Remote::Hold(const HoldRemote& order) {
  reading_.there = true;
  for (std::size_t key = 0; key < down_until_.size(); ++key) {
    if (Has(order.keys, key)) down_until_[key] = kForever;
  }
}

void Remote::Release(const ReleaseRemote& order) {
  reading_.there = true;
  for (std::size_t key = 0; key < down_until_.size(); ++key) {
    if (Has(order.keys, key)) down_until_[key] = 0;
  }
}

void Remote::Move(const MoveSticks& order, double t) {
  reading_.there = true;
  const double until = order.seconds > 0 ? t + order.seconds : kForever;
  const std::optional<double> values[] = {order.lx, order.ly, order.rx, order.ry};
  for (std::size_t i = 0; i < sticks_.size(); ++i) {
    if (values[i]) sticks_[i] = {.value = std::clamp(*values[i], -1.0, 1.0), .until = until};
  }
}

void Remote::Set(const SetRemote& order, double t) {
  reading_.there = true;
  const robot::RemoteReading& to = order.reading;
  const double until = t + order.seconds;
  for (std::size_t key = 0; key < down_until_.size(); ++key) {
    down_until_[key] = Has(to.keys, key) ? until : 0;
  }
  const double values[] = {to.lx, to.ly, to.rx, to.ry};
  for (std::size_t i = 0; i < sticks_.size(); ++i) {
    sticks_[i] = {.value = std::clamp(values[i], -1.0, 1.0), .until = until};
  }
}

void Remote::Switch(const SwitchRemote& order) {
  if (!order.on) *this = Remote();
  reading_.there = order.on;
}

const robot::RemoteReading& Remote::Read(double t) {
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

}  // namespace understudy::emulator
