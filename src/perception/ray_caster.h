// All that rays can meet in a world, at one instant.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mjcf/mesh_file.h"
#include "mjcf/mujoco_handles.h"
#include "perception/box_tree.h"
#include "perception/ray.h"
#include "perception/shape.h"

namespace understudy::perception {

// Holds the geoms that collide, of robots and ground alike: two trees of boxes, one of what stands
// still, made once, one of what moves. What a ray meets, and where, is what mj_ray says but for
// rounding (1e-9 m); mj_ray tries every geom and every triangle. Allocates in the constructor only;
// Cast may be called from several threads.
class RayCaster {
 public:
  // `data` has the model's kinematics. What is met of `scan`, triangles in the world [m], counts as
  // mjcf::kScanGround, which is then not met itself; null: there is none. Keeps nothing of any.
  RayCaster(const mjModel& model, const mjData& data,
            const std::vector<mjcf::MeshPart>* scan = nullptr);

  // Takes the poses of a step of the same model, once however often it is called for that step.
  void Follow(std::int64_t step, const mjData& data);

  // Returns what the ray meets first, leaving out the geoms of `without`.
  Hit Cast(const Ray& ray, std::span<const int> without = {}) const;

  // Returns the convex geoms in which a point [m] of the world lies.
  std::vector<int> Around(const Eigen::Vector3d& p_WP) const;

 private:
  std::int64_t followed_ = -1;  // the last step of Follow
  std::vector<Shape> planes_, still_, moving_;
  std::vector<Box> boxes_;  // of moving_
  BoxTree still_tree_, moving_tree_;
};

}  // namespace understudy::perception
