#include "physics/loose_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <mujoco/mujoco.h>

#include "physics/geom_extent.h"

namespace understudy::physics {
namespace {

// Returns how far [m] what collides of a body reaches below its origin.
double FootOf(const mjModel& model, int body) {
  constexpr mjtNum kDown[3] = {0, 0, -1};
  double foot = 0;
  const int first = model.body_geomadr[body];
  for (int geom = first; geom < first + model.body_geomnum[body]; ++geom) {
    if (!Collides(model, geom)) continue;
    mjtNum back[4], down[3];
    mju_negQuat(back, model.geom_quat + 4 * geom);
    mju_rotVecQuat(down, kDown, back);
    foot = std::max(foot, Reach(model, geom, down) - model.geom_pos[3 * geom + 2]);
  }
  return foot;
}

}  // namespace

std::vector<LooseBody> FindLooseBodies(const mjModel& model, std::span<const RobotBody> robots) {
  std::vector<LooseBody> found;
  for (int body = 1; body < static_cast<int>(model.nbody); ++body) {
    const int joint = model.body_jntadr[body];
    const char* name = mj_id2name(&model, mjOBJ_BODY, body);
    if (joint < 0 || model.jnt_type[joint] != mjJNT_FREE || name == nullptr) continue;
    if (std::ranges::any_of(robots, [body](const RobotBody& one) { return one.Has(body); })) {
      continue;
    }
    found.push_back({.name = name,
                     .body = body,
                     .q = static_cast<std::size_t>(model.jnt_qposadr[joint]),
                     .v = static_cast<std::size_t>(model.jnt_dofadr[joint]),
                     .foot = FootOf(model, body)});
  }
  return found;
}

void Place(const LooseBody& loose, const Eigen::Vector3d& p_WP, double yaw, const mjModel& model,
           mjData* data) {
  const std::array<mjtNum, 7> pose{p_WP.x(), p_WP.y(), p_WP.z() + loose.foot, std::cos(yaw / 2),
                                   0,        0,        std::sin(yaw / 2)};
  std::ranges::copy(pose, data->qpos + loose.q);
  mju_zero(data->qvel + loose.v, 6);
  mj_kinematics(&model, data);
}

}  // namespace understudy::physics
