// Counts of a port.
#pragma once

#include <cstdint>

namespace understudy::robot {

// Counts since the start.
struct PortCounts {
  std::uint64_t unused_slots = 0;    // slots without a motor that got gains or torque; ignored
  std::uint64_t unset_heads = 0;     // go: commands whose head and level_flag were left 0
  std::uint64_t lowstates = 0;       // how often rt/lowstate was due, with readers or without
  std::uint64_t write_failures = 0;  // messages that Cyclone refused
};

// What is new since it was last asked for.
struct PortNews {
  std::uint64_t write_failures = 0;  // messages that the bus did not take
  bool unused_slot = false;          // the first command to a slot without a motor
  bool unset_head = false;           // the first command whose head was left 0
  int writers = 0;  // of rt/lowcmd; 0 unless there are others than before, and several
};

}  // namespace understudy::robot
