// Finds the geoms that are feet.
#pragma once

#include <vector>

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"

namespace understudy::physics {

// For each geom of the model the index of its foot in spec.feet, or -1. A foot has the geoms that
// it names. When none of them is in the model, the foot is searched for with the joints at zero: it
// has the colliding geoms of the lowest body moved by motors whose joints begin as the foot does
// (FR, left), as far as they reach within 1 cm of the lowest. `data` has the kinematics of joints
// at zero.
std::vector<int> FindFeet(const mjModel& model, const mjData& data, const robot::RobotSpec& spec);

}  // namespace understudy::physics
