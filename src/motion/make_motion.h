// Makes the controller of a robot's motion services.
#pragma once

#include <memory>

#include "authority/motion.h"
#include "physics/robot_body.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// Never returns null. It protects the robot by itself (motion/protection.h). `spec` and the body's
// model must outlive it. `damping_kd` [N·m·s/rad] is for robots that only damp: those without a
// controller, and models whose feet are not found.
std::unique_ptr<authority::Motion> MakeMotion(const robot::RobotSpec& spec,
                                              const physics::RobotBody& body, double damping_kd);

}  // namespace understudy::motion
