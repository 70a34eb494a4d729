// Measures a robot's model, for a description that is being written.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"

namespace understudy::physics {

// A joint of the model and its angle [rad].
struct JointAngle {
  std::string joint;
  double q = 0;
};

// Returns the names of the geoms with which a leg stands: the colliding geoms of the lowest body
// that these joints move, at angles 0 (physics/feet.h). Geoms without a name are not listed.
std::vector<std::string> SoleGeoms(const mjModel& model, const std::vector<std::string>& joints);

// Returns the height [m] of the base, which has a free joint and the orientation w, x, y, z, at
// which the robot's lowest colliding point is at 0; 0 if nothing collides. Joints that are not
// listed are where the model has them.
double HeightOnGround(const mjModel& model, const std::string& base,
                      const std::array<double, 4>& orientation,
                      const std::vector<JointAngle>& angles);

}  // namespace understudy::physics
