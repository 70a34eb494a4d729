// Finds the geoms of the feet.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"

namespace understudy::physics {

// Returns the colliding geoms of the lowest body that one of these joints moves, for the kinematics
// in `data`: those that reach within 1 cm of the lowest point. Empty if there are none. Ignores
// joints that the model lacks.
std::vector<int> LowestGeoms(const mjModel& model, const mjData& data,
                             const std::vector<std::string>& joints);

// Returns the geoms of each foot, in the order of spec.feet. A foot has the geoms that it names. If
// none of them is in the model, it gets the colliding geoms of the lowest body (at joint angles 0)
// that is moved by motors whose joints begin like the foot's name (FR, left); only geoms that reach
// within 1 cm of the lowest point count. `data` has the kinematics at joint angles 0.
std::vector<std::vector<int>> FootGeoms(const mjModel& model, const mjData& data,
                                        const robot::RobotSpec& spec);

// What helps a foot without geoms, the one of that index in spec.feet.
std::string FeetRemedy(std::size_t foot);

// Returns for each geom of the model the index of its foot (FootGeoms), or -1.
std::vector<int> FindFeet(const mjModel& model, const mjData& data, const robot::RobotSpec& spec);

}  // namespace understudy::physics
