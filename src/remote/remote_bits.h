// The bit of a key of the remote controller, when the program is compiled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "robot/remote_keys.h"

namespace understudy::remote {

// A name that is none does not compile.
consteval std::uint16_t RemoteBit(std::string_view name) {
  for (std::size_t bit = 0; bit < robot::kRemoteKeys.size(); ++bit) {
    if (robot::kRemoteKeys[bit] == name) return static_cast<std::uint16_t>(1U << bit);
  }
  throw "no such key of the remote controller";
}

}  // namespace understudy::remote
