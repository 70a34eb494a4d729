#include "physics/joint_dynamics.h"

#include <algorithm>

#include <mujoco/mujoco.h>

#include "mjcf/mujoco_handles.h"

namespace understudy::physics {
namespace {

void SetIfGiven(double figure, mjtNum* value) {
  if (figure >= 0) *value = figure;
}

}  // namespace

void UseFittedDynamics(const robot::RobotSpec& spec, mjModel* model) {
  if (spec.dynamics.use != robot::DynamicsSource::kFitted) return;
  for (const robot::MotorSpec& motor : spec.motors) {
    const int dof = model->jnt_dofadr[mj_name2id(model, mjOBJ_JOINT, motor.joint.c_str())];
    for (const robot::FittedDynamicsSpec& fit : spec.dynamics.fitted) {
      if (std::ranges::find(fit.slots, motor.slot) == fit.slots.end()) continue;
      if (motor.armature == 0) SetIfGiven(fit.armature, model->dof_armature + dof);
      SetIfGiven(fit.damping, model->dof_damping + dof);
      SetIfGiven(fit.frictionloss, model->dof_frictionloss + dof);
    }
  }
  const mjcf::DataHandle data(mj_makeData(model));
  mj_setConst(model, data.get());
}

}  // namespace understudy::physics
