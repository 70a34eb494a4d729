// The voltages of a pack's cells, as messages have them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "robot/robot_spec.h"
#include "robot/robot_values.h"
#include "wire/rounded.h"
#include "wire/slots.h"

namespace understudy::wire {

static_assert(robot::kMostCells >= kHgCells && robot::kMostCells >= kGoCells);

// Returns the voltage of a cell, mV.
inline std::uint16_t CellMillivolt(const robot::BatteryReading& battery,
                                   const robot::BatterySpec& spec, std::size_t cell) {
  return Rounded<std::uint16_t>(1000 * (battery.voltage / spec.cells + battery.cell_off_v[cell]));
}

}  // namespace understudy::wire
