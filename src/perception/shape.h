// Where a ray meets one geom.
#pragma once

#include <memory>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "perception/box_tree.h"
#include "perception/ray.h"

namespace understudy::perception {

// The triangles of a mesh or a height field in its frame.
class Triangles {
 public:
  using Corners = std::array<Eigen::Vector3d, 3>;  // m

  explicit Triangles(std::vector<Corners> triangles);
  // Returns the distance to the nearest one, from either side; kNoHit if there is none before
  // `nearest`.
  double Distance(const Ray& ray, double nearest) const;

  const Eigen::Vector3d& low() const { return low_; }
  const Eigen::Vector3d& high() const { return high_; }

 private:
  std::vector<Corners> triangles_;  // in the order of the tree's leaves
  BoxTree tree_;
  Eigen::Vector3d low_, high_;
};

// Returns the triangles of a geom's mesh, or of its height field as MuJoCo has it: two a cell,
// walls down to the base, and its bottom.
Triangles TrianglesOf(const mjModel& model, int geom);

// A geom at one instant. Distances are those of mj_ray: a solid is met from inside too, a plane
// from its front alone.
struct Shape {
  int geom = -1;
  int type = 0;  // mjtGeom
  Eigen::Vector3d size{0, 0, 0};
  std::shared_ptr<const Triangles> triangles{};  // of a mesh or a height field
  Eigen::Vector3d p_WG{0, 0, 0};                 // m
  Eigen::Matrix3d R_WG = Eigen::Matrix3d::Identity();

  // Reads the geom's pose.
  void Follow(const mjData& data);
  // Returns the distance [m] in the world, or kNoHit; beyond `nearest` it may be either.
  double Distance(const Ray& ray, double nearest) const;
  // Returns its box in the world. Not for planes.
  Box Bounds() const;
};

}  // namespace understudy::perception
