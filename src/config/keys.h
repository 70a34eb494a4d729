// Lists the keys of the configuration, one row each.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "config/archive.h"
#include "config/config.h"

namespace understudy::config {

inline constexpr double kMaxInt = std::numeric_limits<int>::max();

// Returns the poses that a run can start in.
const std::vector<std::string>& StartPoses();

void Describe(Archive& archive, Config& config);
void Describe(Archive& archive, robot::RobotSpec& robot);
void DescribeMotionService(Archive& archive, robot::MotionSpec& motion);
void DescribeSensors(Archive& archive, sensors::SensorConfig& sensors);
// Only `scene` and `terrain`, which are the keys that a scene's YAML file may have.
void DescribeScene(Archive& archive, Config& config);

}  // namespace understudy::config
