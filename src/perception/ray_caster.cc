#include "perception/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <mujoco/mujoco.h>

#include "mjcf/eigen_views.h"
#include "physics/geom_extent.h"

namespace understudy::perception {
namespace {

// Mocap bodies have no joints, and move.
bool Moves(const mjModel& model, int body) {
  for (int b = body; b != 0; b = model.body_parentid[b]) {
    if (model.body_mocapid[b] >= 0) return true;
  }
  return model.body_weldid[body] != 0;
}

std::vector<Box> BoxesOf(const std::vector<Shape>& shapes) {
  std::vector<Box> boxes;
  for (const Shape& shape : shapes) boxes.push_back(shape.Bounds());
  return boxes;
}

Triangles ScanTriangles(const std::vector<mjcf::MeshPart>& scan) {
  std::vector<Triangles::Corners> triangles;
  for (const mjcf::MeshPart& part : scan) {
    const std::vector<float>& x = part.corners;
    for (std::size_t i = 0; i + 9 <= x.size(); i += 9) {
      triangles.push_back({Eigen::Vector3d(x[i], x[i + 1], x[i + 2]),
                           Eigen::Vector3d(x[i + 3], x[i + 4], x[i + 5]),
                           Eigen::Vector3d(x[i + 6], x[i + 7], x[i + 8])});
    }
  }
  return Triangles(std::move(triangles));
}

}  // namespace

RayCaster::RayCaster(const mjModel& model, const mjData& data,
                     const std::vector<mjcf::MeshPart>* scan) {
  const int ground = scan == nullptr ? -1 : mj_name2id(&model, mjOBJ_GEOM, mjcf::kScanGround);
  if (scan != nullptr) {
    still_.push_back({.geom = ground,
                      .type = mjGEOM_MESH,
                      .triangles = std::make_shared<const Triangles>(ScanTriangles(*scan))});
  }
  std::map<std::pair<int, int>, std::shared_ptr<const Triangles>> shared;  // by type and mesh
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int type = model.geom_type[geom];
    if (!physics::Collides(model, geom) || type > mjGEOM_MESH || geom == ground) continue;
    Shape shape{.geom = geom, .type = type, .size = mjcf::Vector(model.geom_size + 3 * geom)};
    if (type == mjGEOM_MESH || type == mjGEOM_HFIELD) {
      auto& triangles = shared[{type, model.geom_dataid[geom]}];
      if (!triangles) triangles = std::make_shared<const Triangles>(TrianglesOf(model, geom));
      shape.triangles = triangles;
    }
    shape.Follow(data);
    const bool moves = Moves(model, model.geom_bodyid[geom]);
    (type == mjGEOM_PLANE ? planes_ : moves ? moving_ : still_).push_back(std::move(shape));
  }
  boxes_ = BoxesOf(moving_);
  constexpr int kLeaf = 2;
  still_tree_ = BoxTree(BoxesOf(still_), kLeaf);
  moving_tree_ = BoxTree(boxes_, kLeaf);
}

void RayCaster::Follow(std::int64_t step, const mjData& data) {
  if (std::exchange(followed_, step) == step) return;
  for (Shape& plane : planes_) plane.Follow(data);
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    moving_[i].Follow(data);
    boxes_[i] = moving_[i].Bounds();
  }
  moving_tree_.Refit(boxes_);
}

Hit RayCaster::Cast(const Ray& ray, std::span<const int> without) const {
  Hit hit;
  const auto meet = [&](const Shape& shape) {
    const double distance = shape.Distance(ray, hit.distance);
    if (distance < hit.distance && std::ranges::find(without, shape.geom) == without.end()) {
      hit = {distance, shape.geom};
    }
  };
  for (const Shape& plane : planes_) meet(plane);
  moving_tree_.Walk(ray, &hit.distance, [&](std::uint32_t i) { meet(moving_[i]); });
  still_tree_.Walk(ray, &hit.distance, [&](std::uint32_t i) { meet(still_[i]); });
  return hit;
}

// A line through a point within a convex solid meets it on both sides.
std::vector<int> RayCaster::Around(const Eigen::Vector3d& p_WP) const {
  std::vector<int> around;
  for (const std::vector<Shape>* const shapes : {&still_, &moving_}) {
    for (const Shape& shape : *shapes) {
      const Eigen::Vector3d up(0, 0, 1);
      if (shape.triangles == nullptr && std::isfinite(shape.Distance({p_WP, up}, kNoHit)) &&
          std::isfinite(shape.Distance({p_WP, -up}, kNoHit))) {
        around.push_back(shape.geom);
      }
    }
  }
  return around;
}

}  // namespace understudy::perception
