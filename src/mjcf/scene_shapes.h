// What stands still in a compiled world: its ground, as simple shapes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {

struct SceneShape {
  enum class Kind { kBox, kEllipsoid, kCylinder, kTriangles };

  std::string name;  // of the geom, "" if it has none
  Kind kind = Kind::kBox;
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();  // in the world
  Eigen::Vector3d size = Eigen::Vector3d::Ones();          // m along its axes, from end to end
  std::array<float, 4> rgba{};                             // 0 to 1
  std::vector<Eigen::Vector3d> corners{};                  // m, in S, three for each triangle
};

// Geoms of higher groups MuJoCo shows only if asked.
inline constexpr int kLastSeenGroup = 2;

// The most squares that a height field is shown with; *assumed*: those of a field of 14 m by 14 m
// in cells of 0.1 m, and 3 MB as the triangles of a message. Of a finer one every second place is
// taken, or every third and so on.
inline constexpr int kMostSquares = 20'000;
// A plane without end is shown this far [m] from the origin; *assumed*.
inline constexpr double kEndlessPlane = 50;

// Returns the geoms of `model` that are fixed to the world and, of groups 0 to 2, seen, without
// those of the robot whose base is the body `base`. A plane becomes a box whose top it is, a
// capsule a cylinder between two spheres, a height field and a mesh triangles, a texture its mean
// colour.
std::vector<SceneShape> SceneShapesOf(const mjModel& model, const std::string& base);

}  // namespace understudy::mjcf
