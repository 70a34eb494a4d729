#include "perception/nearest_obstacle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <mujoco/mujoco.h>

#include "mjcf/eigen_views.h"
#include "physics/geom_extent.h"

namespace understudy::perception {
namespace {

using Eigen::Array2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Along the base's x, level, and to the left of that.
std::array<Vector3d, 2> LevelAxesOf(const mjData& data, int base) {
  const mjcf::RotationView R_WB(data.xmat + 9 * base);
  const double yaw = std::atan2(R_WB(1, 0), R_WB(0, 0));
  return {Vector3d(std::cos(yaw), std::sin(yaw), 0), Vector3d(-std::sin(yaw), std::cos(yaw), 0)};
}

}  // namespace

NearestObstacle::NearestObstacle(const physics::MujocoWorld& world, std::size_t robot)
    : rays_(world.model(), world.data(), world.scan()),
      base_(world.robot(robot).Body(world.robot(robot).spec().base_body)) {
  const mjModel& model = world.model();
  const mjData& data = world.data();
  const auto axes = LevelAxesOf(data, base_);
  const Vector3d p_WB = mjcf::Vector(data.xpos + 3 * base_);
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int body = model.geom_bodyid[geom];
    if (!world.robot(robot).Has(body)) continue;
    own_.push_back(geom);
    if (body != base_ && model.body_parentid[body] != base_) continue;
    const mjcf::RotationView R_WG(data.geom_xmat + 9 * geom);
    const Vector3d p_BG = mjcf::Vector(data.geom_xpos + 3 * geom) - p_WB;
    for (int i = 0; i < 2; ++i) {
      const Vector3d& axis = axes[static_cast<std::size_t>(i)];
      const Vector3d ahead = R_WG.transpose() * axis, back = -ahead;
      const double at = p_BG.dot(axis);
      high_[i] = std::max(high_[i], at + physics::Reach(model, geom, ahead.data()));
      low_[i] = std::min(low_[i], at - physics::Reach(model, geom, back.data()));
    }
  }
}

double NearestObstacle::Measure(std::int64_t step, const mjData& data) {
  rays_.Follow(step, data);
  const auto axes = LevelAxesOf(data, base_);
  const Vector3d p_WB = mjcf::Vector(data.xpos + 3 * base_);
  double nearest = kFarthest;
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRays;
    const Vector2d along(std::cos(angle), std::sin(angle));
    const Hit hit = rays_.Cast({p_WB, along.x() * axes[0] + along.y() * axes[1]}, own_);
    if (!std::isfinite(hit.distance)) continue;
    const Array2d at = (hit.distance * along).array();
    const Array2d off = (low_ - at).max(at - high_).max(0.0);
    nearest = std::min(nearest, off.matrix().norm());
  }
  return nearest;
}

}  // namespace understudy::perception
