// Changes a model where the robot's description differs from its file.
#pragma once

#include "mjcf/document.h"
#include "robot/robot_spec.h"

namespace understudy::mjcf {

// Gives bodies, sites and motors' joints the figures of spec.bodies, spec.sites and
// spec.motors[].armature, and takes spec.locked_joints out with what reads or drives them, where
// the model has them. A body that keeps its mass, centre or inertia keeps its <inertial> for the
// rest.
//
// Throws ModelError with the key when the model has no such body or site, or when only part of
// mass, com and inertia is said of a body whose file leaves them to its geoms.
void Revise(const robot::RobotSpec& spec, MjcfElement* root);

}  // namespace understudy::mjcf
