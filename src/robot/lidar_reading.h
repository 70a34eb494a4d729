// What a lidar and the programs beside it say.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "robot/robot_values.h"

namespace understudy::robot {

// An echo.
struct LidarPoint {
  float x = 0, y = 0, z = 0;  // m
  float intensity = 0;        // 0 to 255
  float time = 0;             // s since the cloud's stamp
};

struct PointCloud {
  std::int64_t stamp_ns = 0;  // of the first sample, simulated time
  std::vector<LidarPoint> points{};
};

// The height of the ground around the robot, in the frame `odom`.
struct HeightMap {
  static constexpr int kCells = 128;     // along each axis
  static constexpr double kCell = 0.06;  // m
  static constexpr float kUnseen = 1e9F;

  Eigen::Vector2d origin{0, 0};  // m, of cell 0
  std::vector<float> heights{};  // m, x first
};

// Small cubes around the robot, full or empty, in the frame `odom`.
struct VoxelMap {
  static constexpr int kAcross = 128, kUp = 38;  // cubes along x and y, along z
  static constexpr double kCell = 0.05;          // m
  // m, where the lowest cubes begin: so on level ground in all recordings that were seen.
  // *Assumed*: on any ground.
  static constexpr double kLowest = -0.6;

  Eigen::Vector3d origin{0, 0, 0};  // m, the middle of the first cube
  std::vector<std::uint8_t>
      bits{};  // eight cubes along x, the first in the highest; then y, then z
};

struct LidarStatus {
  bool blind = false;    // no echo comes back
  double dirt = 0;       // share of its window
  double points_hz = 0;  // echoes a second
};

// Everything that a lidar publishes, each part as of its last instant.
struct LidarReading {
  std::int64_t since_ns = 0;           // when the robot was switched on: stamps count from there
  std::int64_t now_ns = 0;             // stamp of all but clouds, simulated time
  PointCloud cloud{};                  // in the lidar's frame
  std::vector<LidarPoint> deskewed{};  // the same points in the frame `odom`, if somebody reads it
  ImuReading imu{};                    // of the lidar's own unit, in the lidar's axes
  LidarStatus status{};
  Eigen::Vector3d clear{0, 0, 0};  // m to what is ahead, to the left and to the right
  HeightMap map{};
  VoxelMap voxels{};
};

}  // namespace understudy::robot
