#include "physics/geom_extent.h"

#include <algorithm>
#include <cmath>

namespace understudy {

bool Collides(const mjModel& model, int geom) {
  return model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0;
}

double LowestPoint(const mjModel& model, const mjData& data, int geom) {
  const mjtNum* size = model.geom_size + 3 * geom;
  const mjtNum* up = data.geom_xmat + 9 * geom + 6;  // the world's up in the geom's frame
  double below = 0;
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      below = size[0];
      break;
    case mjGEOM_CAPSULE:
      below = size[0] + std::abs(up[2]) * size[1];
      break;
    case mjGEOM_CYLINDER:
      below = std::hypot(up[0], up[1]) * size[0] + std::abs(up[2]) * size[1];
      break;
    case mjGEOM_BOX:
      below = std::abs(up[0]) * size[0] + std::abs(up[1]) * size[1] + std::abs(up[2]) * size[2];
      break;
    case mjGEOM_ELLIPSOID:
      below = std::hypot(up[0] * size[0], up[1] * size[1], up[2] * size[2]);
      break;
    case mjGEOM_MESH: {
      const int mesh = model.geom_dataid[geom];
      const float* v = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
      for (int i = 0; i < model.mesh_vertnum[mesh]; ++i, v += 3) {
        below = std::max(below, -(up[0] * v[0] + up[1] * v[1] + up[2] * v[2]));
      }
      break;
    }
    default:  // no other shape can move
      break;
  }
  return data.geom_xpos[3 * geom + 2] - below;
}

}  // namespace understudy
