#include "physics/joint_dynamics.h"

#include <algorithm>

#include "mjcf/mujoco_handles.h"

namespace understudy {
namespace {

void SetIfGiven(double figure, mjtNum* value) {
  if (figure >= 0) *value = figure;
}

}  // namespace

void UseFittedDynamics(const RobotSpec& spec, mjModel* model) {
  if (spec.dynamics.use != DynamicsSource::kFitted) return;
  for (const MotorSpec& motor : spec.motors) {
    const int dof = model->jnt_dofadr[mj_name2id(model, mjOBJ_JOINT, motor.joint.c_str())];
    for (const FittedDynamicsSpec& fit : spec.dynamics.fitted) {
      if (std::ranges::find(fit.slots, motor.slot) == fit.slots.end()) continue;
      if (motor.armature == 0) SetIfGiven(fit.armature, model->dof_armature + dof);
      SetIfGiven(fit.damping, model->dof_damping + dof);
      SetIfGiven(fit.frictionloss, model->dof_frictionloss + dof);
    }
  }
  const DataHandle data(mj_makeData(model));
  mj_setConst(model, data.get());
}

}  // namespace understudy
