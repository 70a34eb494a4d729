#include "physics/stature.h"

#include <algorithm>
#include <limits>

#include <mujoco/mujoco.h>

#include "physics/feet.h"
#include "physics/geom_extent.h"

namespace understudy::physics {

std::vector<std::string> SoleGeoms(const mjModel& model, const std::vector<std::string>& joints) {
  const mjcf::DataHandle data = mjcf::MakeDataWithoutContacts(model);
  mj_kinematics(&model, data.get());
  std::vector<std::string> names;
  for (const int geom : LowestGeoms(model, *data, joints)) {
    const char* const name = mj_id2name(&model, mjOBJ_GEOM, geom);
    if (name != nullptr) names.emplace_back(name);
  }
  return names;
}

double HeightOnGround(const mjModel& model, const std::string& base,
                      const std::array<double, 4>& orientation,
                      const std::vector<JointAngle>& angles) {
  const mjcf::DataHandle data = mjcf::MakeDataWithoutContacts(model);
  const int body = mj_name2id(&model, mjOBJ_BODY, base.c_str());
  mjtNum* const place = data->qpos + model.jnt_qposadr[model.body_jntadr[body]];
  place[2] = 0;
  std::ranges::copy(orientation, place + 3);
  for (const JointAngle& angle : angles) {
    const int joint = mj_name2id(&model, mjOBJ_JOINT, angle.joint.c_str());
    if (joint >= 0) data->qpos[model.jnt_qposadr[joint]] = angle.q;
  }
  mj_kinematics(&model, data.get());
  double lowest = std::numeric_limits<double>::infinity();
  for (int geom = 0; geom < static_cast<int>(model.ngeom); ++geom) {
    if (Collides(model, geom)) lowest = std::min(lowest, LowestPoint(model, *data, geom));
  }
  return lowest < std::numeric_limits<double>::infinity() ? -lowest : 0;
}

}  // namespace understudy::physics
