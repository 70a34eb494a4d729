#include "physics/robot_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/eigen_views.h"
#include "mjcf/join.h"
#include "physics/feet.h"
#include "physics/set_down.h"
#include "physics/world_model.h"

namespace understudy::physics {

using mjcf::Vector;

namespace {

// Whether an equality constraint acts: part of the state since MuJoCo 3.
#if mjVERSION_HEADER < 300
auto* Active(mjModel* model, mjData*) { return model->eq_active; }
#else
auto* Active(mjModel*, mjData* data) { return data->eq_active; }
#endif

// How many numbers a joint has in qpos.
int Positions(int joint_type) {
  if (joint_type == mjJNT_FREE) return 7;
  return joint_type == mjJNT_BALL ? 4 : 1;
}

}  // namespace

constexpr double kSeized = 1e4;  // N·m of friction that nothing overcomes, assumed

RobotBody::RobotBody(mjModel* model, mjData* data, const PlacedRobot& robot, const mjModel* nominal)
    : model_(model),
      nominal_(nominal),
      data_(data),
      prefix_(robot.prefix),
      spec_(mjcf::WithPrefix(robot.prefix, robot.spec)),
      x_(robot.x),
      y_(robot.y),
      yaw_(robot.yaw) {
  for (const robot::MotorSpec* motor : robot::AllMotors(spec_)) {
    const int joint = mj_name2id(model_, mjOBJ_JOINT, motor->joint.c_str());
    q_address_.push_back(model_->jnt_qposadr[joint]);
    const int dof = dq_address_.emplace_back(model_->jnt_dofadr[joint]);
    const mjtNum* impedance = model_->dof_solimp + mjNIMP * dof;
    friction_.push_back({model_->dof_frictionloss[dof], {impedance[0], impedance[1]}});
  }
  q_.resize(q_address_.size());
  dq_.resize(dq_address_.size());
  for (const robot::FootSpec& foot : spec_.feet) foot_axis_.push_back(foot.axis);
  foot_of_geom_ = FindFeet(*model_, *data_, spec_);
  touch_ = Touch(*model_, robot.spec, prefix_);
  base_body_ = Body(robot.spec.base_body);
  clamp_ = mj_name2id(model_, mjOBJ_EQUALITY, (prefix_ + kClampName).c_str());
  if (!has_fixed_base()) {
    const int joint = model_->body_jntadr[base_body_];
    base_q_ = model_->jnt_qposadr[joint];
    base_dq_ = model_->jnt_dofadr[joint];
  }
  imu_ = FindImu(spec_.imu.site);
  secondary_imu_ = FindImu(spec_.imu.secondary_site);
  imu_.ReadMotion(*model_, *data_);
  if (!spec_.imu.site.empty()) {
    const mjtNum* base = data_->xmat + 9 * base_body_;
    imu_up_ = Imu().R_WI.conjugate() * Eigen::Vector3d(base[2], base[5], base[8]);
  }
}

void RobotBody::Reset(const robot::PoseSpec& pose) {
  Forget();
  Clamp(false);
  if (!has_fixed_base()) {
    mjtNum* base = data_->qpos + base_q_;
    const mjtNum position[3] = {x_, y_, pose.height};
    mju_copy3(base, position);
    mjtNum turn[4];
    const mjtNum up[3] = {0, 0, 1};
    mju_axisAngle2Quat(turn, up, yaw_);
    mju_mulQuat(base + 3, turn, pose.quat.data());
    mju_normalize4(base + 3);
  }
  for (std::size_t i = 0; i < pose.q.size(); ++i) data_->qpos[q_address_[i]] = pose.q[i];
  if (!has_fixed_base()) {
    data_->qpos[base_q_ + 2] += LiftOntoGround(*model_, data_, base_body_, base_q_);
  }
  mj_forward(model_, data_);
  ReadMotion();
  ReadAcceleration();
}

// Resets the joints of the base's kinematic tree as mj_resetData does.
void RobotBody::Forget() {
  const int root = model_->body_rootid[base_body_];
  const auto is_own = [&](int body) { return model_->body_rootid[body] == root; };
  for (int joint = 0; joint < model_->njnt; ++joint) {
    if (!is_own(model_->jnt_bodyid[joint])) continue;
    const int q = model_->jnt_qposadr[joint];
    mju_copy(data_->qpos + q, model_->qpos0 + q, Positions(model_->jnt_type[joint]));
  }
  for (int dof = 0; dof < model_->nv; ++dof) {
    if (!is_own(model_->dof_bodyid[dof])) continue;
    for (mjtNum* of : {data_->qvel, data_->qacc_warmstart, data_->qfrc_applied}) of[dof] = 0;
  }
  for (int body = 0; body < model_->nbody; ++body) {
    if (is_own(body)) mju_zero(data_->xfrc_applied + 6 * body, 6);
  }
}

void RobotBody::Drive(std::span<const double> tau) {
  for (std::size_t i = 0; i < q_.size(); ++i) data_->qfrc_applied[dq_address_[i]] = tau[i];
}

void RobotBody::SetRates(std::span<const double> dq) {
  for (std::size_t i = 0; i < dq.size(); ++i) data_->qvel[dq_address_[i]] = dq[i];
}

void RobotBody::Clamp(bool on) {
  if (has_fixed_base()) return;
  Active(model_, data_)[clamp_] = on;
  if (!on) return;
  // eq_data of a weld: anchor in the second body (the world), the same point in the first (the
  // base), attitude of the second in the first, scale. The point is the base's origin: with a
  // distant one, small errors of attitude would become large displacements.
  mjtNum* pose = model_->eq_data + mjNEQDATA * clamp_;
  mju_copy3(pose, data_->qpos + base_q_);
  mju_zero3(pose + 3);
  mju_negQuat(pose + 6, data_->qpos + base_q_ + 3);
}

std::span<const double> RobotBody::base_position() const {
  if (has_fixed_base()) return {};
  return {data_->qpos + base_q_, 7};
}

std::span<const double> RobotBody::base_velocity() const {
  if (has_fixed_base()) return {};
  return {data_->qvel + base_dq_, 6};
}

bool RobotBody::Has(int body) const {
  return model_->body_rootid[body] == model_->body_rootid[base_body_];
}

bool RobotBody::clamped() const { return has_fixed_base() || Active(model_, data_)[clamp_] != 0; }

void RobotBody::Brake(std::size_t motor, double drag, Grip grip) {
  const int dof = dq_address_[motor];
  const JointFriction& friction = friction_[motor];
  model_->dof_frictionloss[dof] = (grip == Grip::kJammed ? kSeized : friction.torque) + drag;
  mjtNum* impedance = model_->dof_solimp + mjNIMP * dof;
  std::ranges::copy(friction.impedance, impedance);
  if (grip != Grip::kYields) std::fill_n(impedance, friction.impedance.size(), mjMAXIMP);
}

std::vector<double> RobotBody::Armatures() const {
  std::vector<double> armatures;
  for (const int dof : dq_address_) armatures.push_back(model_->dof_armature[dof]);
  return armatures;
}

void RobotBody::FrictionPower(std::span<double> power) const {
  for (std::size_t i = 0; i < dq_address_.size(); ++i) {
    const int dof = dq_address_[i];
    const double dry = model_->dof_frictionloss[dof];
    const double rate = std::abs(dq_[i]);
    power[i] = dry >= kSeized ? 0 : (dry + model_->dof_damping[dof] * rate) * rate;
  }
}

std::vector<std::array<double, 2>> RobotBody::ranges() const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<std::array<double, 2>> ranges;
  for (const int dof : dq_address_) {
    const int joint = model_->dof_jntid[dof];
    const mjtNum* range = model_->jnt_range + 2 * joint;
    const bool limited = model_->jnt_limited[joint] != 0;
    ranges.push_back(limited ? std::array{range[0], range[1]} : std::array{-kNone, kNone});
  }
  return ranges;
}

int RobotBody::FindBody(const std::string& name) const {
  return mj_name2id(model_, mjOBJ_BODY, (prefix_ + name).c_str());
}

int RobotBody::Body(const std::string& name) const {
  const int body = FindBody(name);
  if (body < 0) throw ModelError("the model has no body '" + name + "'");
  return body;
}

double RobotBody::tilt() const {
  return std::acos(std::clamp(data_->xmat[9 * base_body_ + 8], -1.0, 1.0));
}

void RobotBody::FootForces(std::span<double> force) const {
  std::fill(force.begin(), force.end(), 0.0);
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    for (const int geom : {contact.geom1, contact.geom2}) {
      const int foot = foot_of_geom_[static_cast<std::size_t>(geom)];
      if (foot < 0) continue;
      mjtNum wrench[6];  // in the contact's frame, whose first axis is the normal
      mj_contactForce(model_, data_, i, wrench);
      const Eigen::Vector3d& axis = foot_axis_[static_cast<std::size_t>(foot)];
      const mjcf::RotationView R_WB(data_->xmat + 9 * model_->geom_bodyid[geom]);
      const double share = axis.isZero() ? 1 : std::abs(Vector(contact.frame).dot(R_WB * axis));
      force[static_cast<std::size_t>(foot)] += share * wrench[0];
    }
  }
}

double RobotBody::weight() const {
  return model_->body_subtreemass[base_body_] * mju_norm3(model_->opt.gravity);
}

Eigen::Vector3d RobotBody::gravity() const { return Vector(model_->opt.gravity); }

InertialUnit RobotBody::FindImu(const std::string& site) const {
  const int id = site.empty() ? -1 : mj_name2id(model_, mjOBJ_SITE, site.c_str());
  return id < 0 ? InertialUnit() : InertialUnit(*model_, id);
}

void RobotBody::ReadMotion() {
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q_[i] = data_->qpos[q_address_[i]];
    dq_[i] = data_->qvel[dq_address_[i]];
  }
  imu_.ReadMotion(*model_, *data_);
  secondary_imu_.ReadMotion(*model_, *data_);
  if (has_fixed_base()) {
    base_.p_WB = Vector(data_->xpos + 3 * base_body_);
    return;
  }
  base_.p_WB = Vector(data_->qpos + base_q_);
  base_.v_WB_W = Vector(data_->qvel + base_dq_);
}

void RobotBody::ReadAcceleration() {
  imu_.ReadAcceleration(*model_, data_);
  secondary_imu_.ReadAcceleration(*model_, data_);
}

}  // namespace understudy::physics
