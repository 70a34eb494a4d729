// What Python gives to robots, worlds and batches alike.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>

#include "config/load.h"
#include "robot/robot_values.h"

namespace understudy::python {

// Fills in q, dq, tau, kp and kd, in this order, of `commands`, `motors` to a robot. Each is a
// number for all, an array with one for each motor of a robot, or an array of all, of shape
// (robots, motors); None leaves the field as it is. Throws std::invalid_argument.
void Fill(const std::array<const nanobind::object*, 5>& given, std::size_t motors,
          std::span<robot::MotorCommand> commands);

// Returns a value of Python as JSON, which is also YAML; numbers and arrays of numpy are known.
// Raises TypeError.
std::string JsonOf(const nanobind::handle& value);

// Returns what `files` (a path or several), `sets` and `seed` say of these robots (names or paths).
// Throws std::invalid_argument if there are none.
config::Layers LayersOf(const std::vector<nanobind::handle>& robots, const nanobind::object& files,
                        const nanobind::dict& sets, const std::optional<int>& seed);

}  // namespace understudy::python
