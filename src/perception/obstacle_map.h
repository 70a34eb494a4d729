// The obstacles around a quadruped, by what its lidar sees.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "robot/robot_values.h"
#include "robot/seen_obstacles.h"

namespace understudy::perception {

// Keeps the echoes of the last two seconds in cells of the frame `odom`. Where the ground is seen
// again after something that moved, a cell forgets that within two windows of a second. A cell is
// an obstacle where its highest echo is further above the ground around it than the robot steps up,
// and lower than what it passes under. All figures are *assumed*: none is published. Allocates in
// the constructor only.
class ObstacleMap {
 public:
  static constexpr double kFarthest = 2.5;  // m from the base that it keeps

  ObstacleMap();

  // Forgets all.
  void Clear();
  // Begins the next cloud. `altitude` [m] is that of the base from anywhere, by its legs: z of odom
  // is the height over the ground below the robot, so a slope that it climbs would move.
  void Begin(const robot::LegOdometry& base, double altitude);
  // Adds an echo [m] in odom; the same in the base's frame tells whether it is the robot's own.
  void Add(const Eigen::Vector3d& p_OP, const Eigen::Vector3d& p_BP);
  // Writes what is seen from the base of the last Begin.
  void Read(robot::SeenObstacles* seen) const;

 private:
  struct Cell {
    std::int64_t x = 0, y = 0;    // in cells from odom's origin
    std::int64_t cloud = kNever;  // the last one with an echo in it
    float low = 0, high = 0;      // m, altitudes of its echoes; the highest of its last window
    float before = 0;             // m, the highest of the window before
    std::int64_t window = 0;
  };
  static constexpr std::int64_t kNever = -1'000'000;
  static constexpr std::int64_t kCells = 64;  // along each side

  static std::size_t PlaceOf(std::int64_t x, std::int64_t y);
  bool IsFresh(const Cell& cell) const;
  bool Blocks(const Cell& cell) const;

  std::vector<Cell> cells_;  // wrapped around
  std::int64_t cloud_ = 0;
  robot::LegOdometry base_;
  double altitude_ = 0;  // m
};

}  // namespace understudy::perception
