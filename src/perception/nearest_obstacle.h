// How far the nearest thing is from a robot, by the truth of the simulation.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "perception/ray_caster.h"
#include "physics/mujoco_world.h"

namespace understudy::perception {

// Looks round at the height of the robot's base, with rays that pass through the robot itself. Its
// outline is the rectangle around its base and the bodies that are joined to that, as they are in
// the constructor. Things that are thinner than 6 cm at a metre may lie between two rays. Allocates
// in the constructor only.
class NearestObstacle {
 public:
  static constexpr double kFarthest = 10;  // m

  // Of a robot by its number in the world. Keeps nothing of `world`.
  NearestObstacle(const physics::MujocoWorld& world, std::size_t robot);

  // Returns the distance [m] from the outline of what is nearest, 0 within it, kFarthest if nothing
  // is nearer. `step` counts the steps of the same world.
  double Measure(std::int64_t step, const mjData& data);

 private:
  static constexpr int kRays = 108;

  RayCaster rays_;
  int base_;                               // body
  std::vector<int> own_;                   // geoms of the robot
  Eigen::Array2d low_{0, 0}, high_{0, 0};  // m, of the outline in the base's frame, level
};

}  // namespace understudy::perception
