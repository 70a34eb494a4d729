// Fits a robot's description to a third-party model.
#pragma once

#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"

namespace understudy::mjcf {

// The description with this model's names where the model lacks the description's own:
//   base body      the one root body with a free joint
//   crane body     the base body
//   joint          the same with or without _joint at its end
//   IMU site       the one site with "imu" in its name, or the one such on the base body; of the
//                  secondary unit the one such elsewhere, else there is no secondary unit
//   a few motors   left out, with their place in poses and parallel pairs, where the model has no
//                  joint for them: fewer than half
// What is not found stays as it is, for RequireWhatSpecNames to refuse. Each change is a line in
// `notes`.
robot::RobotSpec FitNames(robot::RobotSpec spec, const mjModel& model,
                          std::vector<std::string>* notes);

}  // namespace understudy::mjcf
