// The pads of a robot's hands: their names, and what each feels.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "robot/robot_spec.h"

namespace understudy::robot {

// Returns the names of all pads, by hand: those of their sites without "_touch", such as
// "left_index_tip"; "" of a pad that feels nothing.
std::vector<std::string> PadNames(const RobotSpec& spec);

// Returns how many cells they have together.
std::size_t CellsOf(const RobotSpec& spec);

// Computes the force [N] on that cell of each pad, as PadNames has them, that feels most. `cells`
// as physics::RobotBody::ReadTouch fills it.
void StrongestCells(const RobotSpec& spec, std::span<const float> cells, std::span<double> pads);

}  // namespace understudy::robot
