// What a port noticed and went on in spite of.
#pragma once

#include <cstdint>

namespace understudy::robot {

// Since start.
struct PortCounts {
  std::uint64_t unused_slots = 0;    // slots without a motor that got gains or torque; ignored
  std::uint64_t unset_heads = 0;     // go: commands whose head and level_flag were left 0
  std::uint64_t lowstates = 0;       // times that rt/lowstate was due, read by somebody or not
  std::uint64_t write_failures = 0;  // messages that the bus did not take
};

}  // namespace understudy::robot
