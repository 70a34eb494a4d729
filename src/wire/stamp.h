// Stamps of ROS messages.
#pragma once

#include <cstdint>

#include "idl/builtin_interfaces.h"

namespace understudy::wire {

inline builtin_interfaces_msg_dds__Time_ StampOf(std::int64_t ns) {
  return {.sec = static_cast<std::int32_t>(ns / 1'000'000'000),
          .nanosec = static_cast<std::uint32_t>(ns % 1'000'000'000)};
}

}  // namespace understudy::wire
