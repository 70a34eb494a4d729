#include "physics/inertial_unit.h"

#include <algorithm>

#include <mujoco/mujoco.h>

#include "mjcf/eigen_views.h"

namespace understudy::physics {
namespace {

// The sum of the columns of `axes` that belong to a body's joints, times their `values`: in
// MuJoCo's order, so that the bits are its, but without its functions, which are made for any size.
void MulJoints(const mjModel& model, int body, const mjtNum* axes, const mjtNum* values,
               mjtNum sum[6]) {
  const int first = model.body_dofadr[body], count = model.body_dofnum[body];
  if (count == 1) {
    for (int i = 0; i < 6; ++i) sum[i] = axes[6 * first + i] * values[first];
    return;
  }
  mjtNum so_far[6] = {};  // which nothing else can point to
  for (int dof = first; dof < first + count; ++dof) {
    const mjtNum value = values[dof];
    if (value == 0) continue;
    for (int i = 0; i < 6; ++i) so_far[i] += axes[6 * dof + i] * value;
  }
  std::copy_n(so_far, 6, sum);
}

}  // namespace

InertialUnit::InertialUnit(const mjModel& model, int site) : site_(site) {
  for (int body = model.site_bodyid[site]; body != 0; body = model.body_parentid[body]) {
    links_.push_back({.body = body});
  }
  std::ranges::reverse(links_);
}

void InertialUnit::ReadMotion(const mjModel& model, const mjData& data) {
  if (site_ < 0) return;
  mjtNum quat[4];
  mju_mat2Quat(quat, data.site_xmat + 9 * site_);
  reading_.R_WI = mjcf::Quaternion(quat);
  mjtNum velocity[6];
  mj_objectVelocity(&model, &data, mjOBJ_SITE, site_, velocity, 1);
  reading_.w_WI_I = mjcf::Vector(velocity);
  for (Link& link : links_) {
    MulJoints(model, link.body, data.cdof_dot, data.qvel, link.by_rate.data());
  }
}

void InertialUnit::ReadAcceleration(const mjModel& model, mjData* data) {
  if (site_ < 0) return;
  mju_zero(data->cacc, 6);
  const bool falls = (model.opt.disableflags & mjDSBL_GRAVITY) == 0;
  if (falls) mju_scl3(data->cacc + 3, model.opt.gravity, -1);
  for (const Link& link : links_) {
    mjtNum* const acceleration = data->cacc + 6 * link.body;
    const mjtNum* const parent = data->cacc + 6 * model.body_parentid[link.body];
    mjtNum by_torque[6];
    MulJoints(model, link.body, data->cdof, data->qacc, by_torque);
    for (int i = 0; i < 6; ++i)
      acceleration[i] = parent[i] + link.by_rate[static_cast<std::size_t>(i)] + by_torque[i];
  }
  // MuJoCo 3 has the acceleration of a body that cannot move at 0.
  if (falls && model.body_weldid[model.site_bodyid[site_]] == 0) {
    reading_.f_WI_I = reading_.R_WI.conjugate() * -mjcf::Vector(model.opt.gravity);
    return;
  }
  mjtNum acceleration[6];
  mj_objectAcceleration(&model, data, mjOBJ_SITE, site_, acceleration, 1);
  reading_.f_WI_I = mjcf::Vector(acceleration + 3);
}

}  // namespace understudy::physics
