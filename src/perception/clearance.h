// How far a robot is from what stands around it, by what its lidar sees.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "robot/lidar_reading.h"

namespace understudy::perception {

// Whether a point [m] of the base's frame is the robot's own, a leg for example; `height` [m] is
// that of the base over the ground. The box that it takes for the robot is *assumed*.
bool IsOfRobot(const Eigen::Vector3d& p, double height);

// The frame of a point is the base's. Of a cloud the nearest echoes in a band ahead, to the left
// and to the right count that are neither ground nor ceiling nor the robot itself; of the last
// clouds the nearest. All figures but the meaning of the three numbers are *assumed*. Allocates
// nothing.
class Clearance {
 public:
  static constexpr double kFarthest = 2;  // m, what it tells where nothing stands

  // Forgets all.
  void Clear() { clouds_ = 0; }
  // Takes a cloud of points [m] and the height [m] of the base over the ground.
  template <class PointAt>
  void Add(std::size_t points, PointAt at, double height) {
    Begin();
    for (std::size_t i = 0; i < points; ++i) Near(at(i), height);
    for (std::size_t i = 0; i < points; ++i) Average(at(i), height);
    End();
  }
  // Returns the distances [m] of the base's origin: ahead, to the left, to the right.
  Eigen::Vector3d Read() const;

 private:
  static constexpr std::size_t kClouds = 5;  // that it remembers: a third of a second of an L1's
  struct Side {
    double nearest = kFarthest, sum = 0;
    int count = 0;
  };

  void Begin();
  void Near(const Eigen::Vector3d& p, double height);
  void Average(const Eigen::Vector3d& p, double height);
  void End();

  std::array<Side, 3> sides_{};
  std::array<Eigen::Vector3d, kClouds> last_{};  // a ring
  std::size_t clouds_ = 0;
};

}  // namespace understudy::perception
