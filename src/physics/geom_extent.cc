#include "physics/geom_extent.h"

#include <algorithm>
#include <cmath>

#include <mujoco/mujoco.h>

namespace understudy::physics {

bool Collides(const mjModel& model, int geom) {
  if (model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0) return true;
  for (int pair = 0; pair < static_cast<int>(model.npair); ++pair) {
    if (model.pair_geom1[pair] == geom || model.pair_geom2[pair] == geom) return true;
  }
  return false;
}

double Reach(const mjModel& model, int geom, const mjtNum direction[3]) {
  const mjtNum* size = model.geom_size + 3 * geom;
  const mjtNum* d = direction;
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      return size[0];
    case mjGEOM_CAPSULE:
      return size[0] + std::abs(d[2]) * size[1];
    case mjGEOM_CYLINDER:
      return std::hypot(d[0], d[1]) * size[0] + std::abs(d[2]) * size[1];
    case mjGEOM_BOX:
      return std::abs(d[0]) * size[0] + std::abs(d[1]) * size[1] + std::abs(d[2]) * size[2];
    case mjGEOM_ELLIPSOID:
      return std::hypot(d[0] * size[0], d[1] * size[1], d[2] * size[2]);
    case mjGEOM_MESH: {
      double reach = 0;
      const int mesh = model.geom_dataid[geom];
      const float* v = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
      for (int i = 0; i < model.mesh_vertnum[mesh]; ++i, v += 3) {
        reach = std::max(reach, d[0] * v[0] + d[1] * v[1] + d[2] * v[2]);
      }
      return reach;
    }
    default:  // no other shape can move
      return 0;
  }
}

double LowestPoint(const mjModel& model, const mjData& data, int geom) {
  const mjtNum* up = data.geom_xmat + 9 * geom + 6;  // the world's up in the geom's frame
  const mjtNum down[3] = {-up[0], -up[1], -up[2]};
  return data.geom_xpos[3 * geom + 2] - Reach(model, geom, down);
}

}  // namespace understudy::physics
