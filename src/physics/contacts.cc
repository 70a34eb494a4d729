#include "physics/contacts.h"

#include <algorithm>

namespace understudy::physics {

void UsePyramids(mjModel* model) {
  model->opt.cone = mjCONE_PYRAMIDAL;
  model->opt.impratio = 1;
  for (int i = 0; i < static_cast<int>(model->ngeom); ++i) {
    model->geom_condim[i] = std::min(model->geom_condim[i], 3);
  }
  for (int i = 0; i < static_cast<int>(model->npair); ++i) {
    model->pair_dim[i] = std::min(model->pair_dim[i], 3);
  }
}

}  // namespace understudy::physics
