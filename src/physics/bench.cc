#include "physics/bench.h"

#include <map>

#include <mujoco/mujoco.h>

#include "physics/joint_dynamics.h"
#include "physics/world_model.h"

namespace understudy::physics {
namespace {

mjcf::ModelHandle Untouched(const PlacedRobot& robot, const std::filesystem::path& scene,
                            double timestep, mjModel** model) {
  mjcf::ModelHandle handle = LoadWorldModel({robot}, scene, timestep);
  handle->opt.disableflags |= mjDSBL_CONTACT;
  *model = handle.get();
  return handle;
}

}  // namespace

Bench::Bench(const PlacedRobot& robot, const std::filesystem::path& scene, double timestep)
    : model_(nullptr),
      world_(Untouched(robot, scene, timestep, &model_), {robot}),
      pose_(robot.spec.hanging) {
  const int base = mj_name2id(model_, mjOBJ_BODY, robot.spec.base_body.c_str());
  std::map<int, std::size_t> limbs;
  for (const robot::MotorSpec* motor : robot::AllMotors(robot.spec)) {
    const int joint = mj_name2id(model_, mjOBJ_JOINT, motor->joint.c_str());
    const int dof = model_->jnt_dofadr[joint];
    const int body = model_->jnt_bodyid[joint];
    const mjtNum* inertia = model_->body_inertia + 3 * body;
    places_.push_back({.dof = dof,
                       .body = body,
                       .joint = {.armature = model_->dof_armature[dof],
                                 .damping = model_->dof_damping[dof],
                                 .frictionloss = model_->dof_frictionloss[dof]},
                       .mass = model_->body_mass[body],
                       .inertia = {inertia, inertia + 3}});
    int first = body;
    while (model_->body_parentid[first] > base) first = model_->body_parentid[first];
    limbs_.push_back(limbs.try_emplace(first, limbs.size()).first->second);
  }
}

void Bench::Use(const robot::RobotSpec& spec, std::span<const double> mass) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    model_->dof_armature[place.dof] = place.joint.armature;
    model_->dof_damping[place.dof] = place.joint.damping;
    model_->dof_frictionloss[place.dof] = place.joint.frictionloss;
    const double factor = mass.empty() ? 1 : mass[i];
    model_->body_mass[place.body] = factor * place.mass;
    mju_scl3(model_->body_inertia + 3 * place.body, place.inertia.data(), factor);
  }
  UseFittedDynamics(spec, model_);
}

void Bench::Start(std::span<const double> q, std::span<const double> dq) {
  pose_.q.assign(q.begin(), q.end());
  robot().Reset(pose_);
  robot().Clamp(true);
  robot().SetRates(dq);
}

JointFigures Bench::Joint(std::size_t motor) const {
  const int dof = places_[motor].dof;
  return {.armature = model_->dof_armature[dof],
          .damping = model_->dof_damping[dof],
          .frictionloss = model_->dof_frictionloss[dof]};
}

BodyFigures Bench::Link(std::size_t motor) const {
  const int body = places_[motor].body;
  mjtNum R[9];
  mju_quat2Mat(R, model_->body_iquat + 4 * body);
  const mjtNum* own = model_->body_inertia + 3 * body;
  const auto entry = [&](int row, int column) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += R[3 * row + k] * own[k] * R[3 * column + k];
    return sum;
  };
  const mjtNum* com = model_->body_ipos + 3 * body;
  return {
      .name = mj_id2name(model_, mjOBJ_BODY, body),
      .mass = model_->body_mass[body],
      .com = {com, com + 3},
      .inertia = {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)}};
}

}  // namespace understudy::physics
