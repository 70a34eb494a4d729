// Applies a robot's description to its model.
#pragma once

#include "mjcf/document.h"
#include "robot/robot_spec.h"

namespace understudy::mjcf {

// Sets the values of spec.bodies, spec.sites and spec.motors[].armature, and removes
// spec.locked_joints, if the model has them, with their sensors and actuators. Values that are not
// given keep those of the body's <inertial>. A site that is the IMU's and that the model lacks is
// added to the base.
//
// Throws ModelError with the key if the model has no such body or site, or if only some of mass,
// com and inertia are given for a body whose file derives them from geoms.
void Revise(const robot::RobotSpec& spec, MjcfElement* root);

// Adds the eyes of spec.cameras, without their lenses: each sees as much as its lens does. A camera
// of the same name goes. The model has the bodies that they name.
void AddCameras(const robot::RobotSpec& spec, MjcfElement* root);

}  // namespace understudy::mjcf
