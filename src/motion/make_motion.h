// The controller that plays a robot's motion services.
#ifndef UNDERSTUDY_MOTION_MAKE_MOTION_H_
#define UNDERSTUDY_MOTION_MAKE_MOTION_H_

#include <memory>

#include "motion/motion.h"
#include "robot/robot_spec.h"

namespace understudy {

// Never null. `damping_kd` [N·m·s/rad] is for robots that can only damp.
std::unique_ptr<Motion> MakeMotion(const RobotSpec& spec, double damping_kd);

}  // namespace understudy

#endif  // UNDERSTUDY_MOTION_MAKE_MOTION_H_
