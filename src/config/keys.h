// The keys of the configuration, one row each.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "config/archive.h"
#include "config/config.h"

namespace understudy::config {

inline constexpr double kMaxInt = std::numeric_limits<int>::max();

// The poses a run can start in.
const std::vector<std::string>& StartPoses();

void Describe(Archive& archive, Config& config);
void Describe(Archive& archive, robot::RobotSpec& robot);
// `scene` and `terrain` alone, which is what a scene's own YAML file may hold.
void DescribeScene(Archive& archive, Config& config);

}  // namespace understudy::config
