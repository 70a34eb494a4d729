// Puts friction, damping and armature of joints into a compiled model.
#pragma once

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"

namespace understudy::physics {

// Gives the motors' joints the figures of spec.dynamics.fitted where spec.dynamics.use asks for
// them; else, and where those say nothing, the model keeps its own. A motor's own armature stands
// over a fitted one. What MuJoCo derives from them is derived anew. The model has the joints that
// `spec` names.
void UseFittedDynamics(const robot::RobotSpec& spec, mjModel* model);

}  // namespace understudy::physics
