// Owners of MuJoCo's C objects.
#ifndef UNDERSTUDY_MJCF_MUJOCO_HANDLES_H_
#define UNDERSTUDY_MJCF_MUJOCO_HANDLES_H_

#include <memory>

#include <mujoco/mujoco.h>

namespace understudy::mjcf {

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelHandle = std::unique_ptr<mjModel, ModelDeleter>;
using DataHandle = std::unique_ptr<mjData, DataDeleter>;

}  // namespace understudy::mjcf

#endif  // UNDERSTUDY_MJCF_MUJOCO_HANDLES_H_
