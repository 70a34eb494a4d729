// What a quadruped's program of obstacle avoidance knows of its surroundings.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

namespace understudy::robot {

// Points of obstacles around the base, at most one by sector: the nearest. Frame: that of the base,
// level, x along its heading.
struct SeenObstacles {
  static constexpr std::size_t kSectors = 72;

  bool known = false;  // a cloud has come since the program looks
  std::size_t count = 0;
  std::array<Eigen::Vector2d, kSectors> points{};  // m

  std::span<const Eigen::Vector2d> all() const { return std::span(points).first(count); }
};

// Returns SportModeState.range_obstacle [m]: how far the base is from what is ahead, to the right,
// behind and to the left, kNoObstacle where nothing is. Order and bands are *assumed*.
std::array<double, 4> RangesOf(const SeenObstacles& seen);

}  // namespace understudy::robot
