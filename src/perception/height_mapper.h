// The map of heights around a robot, made of what its lidar sees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "robot/lidar_reading.h"

namespace understudy::perception {

// Adds clouds in the frame `odom` to a map whose middle is the robot. How a real one weighs echoes
// is not known; *assumed*: within kLevel of a cell's height they change it by a share, higher ones
// replace it, and lower ones change nothing, so that what has moved away stays until the robot has
// left it. Allocates in the constructor only.
class HeightMapper {
 public:
  HeightMapper();

  // Forgets all.
  void Clear();
  // Moves the middle to p [m].
  void Follow(const Eigen::Vector2d& p);
  // Adds an echo [m]; outside of the map it has no effect.
  void Add(const Eigen::Vector3d& p);
  // Writes the map.
  void Read(robot::HeightMap* map) const;

 private:
  static constexpr int kCells = robot::HeightMap::kCells;

  // Where a cell of odom is among the heights: the map wraps around.
  static std::size_t PlaceOf(std::int64_t x, std::int64_t y);

  std::int64_t x_ = 0, y_ = 0;  // of its first cell, in cells from odom's origin
  std::vector<float> heights_;  // m
};

}  // namespace understudy::perception
