// What a robot's lidar saw before an instant of a recording, from above.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "robot/robot_spec.h"

namespace understudy::rehearse {

// Points [m] in the level frame of the base at an instant: x ahead, y to the left, z up from the
// base.
using LidarView = std::vector<Eigen::Vector3f>;

// Reads the last clouds before `at` [s, simulated], as many as show a room, and places each where
// the robot truly was. `spec` names bodies as the recorded model does. Empty where the recording
// has no cloud then. Throws RecordError and ModelError.
LidarView ReadLidarView(const std::filesystem::path& recording, const robot::RobotSpec& spec,
                        double at);

// Returns an <svg> element: the points from above, the robot in the middle facing up, by their
// height over the ground, which is where the lowest points are.
std::string DrawLidarView(const LidarView& points);

}  // namespace understudy::rehearse
