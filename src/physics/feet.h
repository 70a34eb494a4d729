// Which geoms are feet.
#ifndef UNDERSTUDY_PHYSICS_FEET_H_
#define UNDERSTUDY_PHYSICS_FEET_H_

#include <vector>

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"

namespace understudy::physics {

// For each geom of the model the index of its foot in spec.feet, or -1. A foot has the geoms that
// it names. One none of whose geoms is in the model is looked for, with the joints at zero: of what
// the motors move whose joints begin as the foot does (FR, left), the colliding geoms of the lowest
// body that reach as low as any, within 1 cm. `data` has the kinematics of joints at zero.
std::vector<int> FindFeet(const mjModel& model, const mjData& data, const robot::RobotSpec& spec);

}  // namespace understudy::physics

#endif  // UNDERSTUDY_PHYSICS_FEET_H_
