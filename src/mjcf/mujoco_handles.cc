#include "mjcf/mujoco_handles.h"

#include <mujoco/mujoco.h>

namespace understudy::mjcf {

void ModelDeleter::operator()(mjModel* model) const { mj_deleteModel(model); }
void DataDeleter::operator()(mjData* data) const { mj_deleteData(data); }

}  // namespace understudy::mjcf
