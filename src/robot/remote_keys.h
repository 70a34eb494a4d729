// Names and bits of the remote controller's keys.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace understudy::robot {

// Bit 0 first (unitree_sdk2 dds_wrapper/common/unitree_joystick.hpp). Requests and files may use
// any case.
inline constexpr std::array<std::string_view, 16> kRemoteKeys = {
    "R1", "L1", "START", "SELECT", "R2", "L2",    "F1",   "F2",
    "A",  "B",  "X",     "Y",      "UP", "RIGHT", "DOWN", "LEFT"};

// Returns the bit of a key at compile time; an unknown name does not compile.
consteval std::uint16_t RemoteBit(std::string_view name) {
  for (std::size_t bit = 0; bit < kRemoteKeys.size(); ++bit) {
    if (kRemoteKeys[bit] == name) return static_cast<std::uint16_t>(1U << bit);
  }
  throw "no such key of the remote controller";
}

// Returns the bits of keys joined by "+": 0x220 for "L2+B"; nullopt for an unknown key.
std::optional<std::uint16_t> RemoteKeys(std::string_view chord);

// Returns the names of the bits, joined by "+" in the order of the bits.
std::string RemoteKeyNames(std::uint16_t keys);
// The same in a room for all of them. Allocates nothing.
using RemoteKeyText = std::array<char, 72>;
std::string_view WriteRemoteKeyNames(std::uint16_t keys, RemoteKeyText* room);

}  // namespace understudy::robot
