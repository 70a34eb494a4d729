// The map of small cubes around a robot, made of what its lidar sees.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "robot/lidar_reading.h"

namespace understudy::perception {

// Adds clouds in the frame `odom` to a map in whose middle the robot stands. A cube is full from an
// echo in it on, for 2.5 to 5 s of clouds after the last: *assumed*, as how a real one fills and
// empties its cubes is not published. Allocates at the first cloud only, for few read this map.
class VoxelMapper {
 public:
  // Forgets all.
  void Clear();
  // Begins the next cloud of a robot at p [m].
  void Begin(const Eigen::Vector2d& p);
  // Adds an echo [m]; outside of the map it has no effect.
  void Add(const Eigen::Vector3d& p);
  // Writes the map.
  void Read(robot::VoxelMap* map) const;

 private:
  static constexpr int kAcross = robot::VoxelMap::kAcross, kUp = robot::VoxelMap::kUp;
  // Along x, cube 0 in the highest bit of the first word. The map wraps around: a cube of odom
  // keeps its place while the robot moves.
  using Row = std::array<std::uint64_t, kAcross / 64>;
  using Cubes = std::vector<Row>;  // y first, then z

  void ForgetWhatIsLeft(std::int64_t x, std::int64_t y);

  std::int64_t x_ = 0, y_ = 0;  // of its first cube, in cubes from odom's origin
  int clouds_ = 0;              // since `before_` was `now_`
  Cubes now_, before_;
};

}  // namespace understudy::perception
