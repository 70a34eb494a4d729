// Sets friction, damping and armature of joints in a compiled model.
#pragma once

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"

namespace understudy::physics {

// Sets the values of spec.dynamics.fitted if spec.dynamics.use is fitted; joints without a fitted
// value keep that of the model. A motor's armature overrides a fitted one. Recomputes the constants
// that MuJoCo derives. The model must have the joints of `spec`.
void UseFittedDynamics(const robot::RobotSpec& spec, mjModel* model);

}  // namespace understudy::physics
