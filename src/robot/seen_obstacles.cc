#include "robot/seen_obstacles.h"

#include <algorithm>
#include <cmath>

#include "robot/robot_values.h"

namespace understudy::robot {

std::array<double, 4> RangesOf(const SeenObstacles& seen) {
  constexpr double kBand = 0.2;  // m, half the width of a band; *assumed*
  std::array<double, 4> ranges;
  ranges.fill(kNoObstacle);
  for (const Eigen::Vector2d& at : seen.all()) {
    const bool along = std::abs(at.y()) < kBand;
    if (!along && std::abs(at.x()) >= kBand) continue;
    const std::size_t side = along ? (at.x() > 0 ? 0 : 2) : (at.y() < 0 ? 1 : 3);
    ranges[side] = std::min(ranges[side], along ? std::abs(at.x()) : std::abs(at.y()));
  }
  return ranges;
}

}  // namespace understudy::robot
