#include "physics/world.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "physics/feet.h"
#include "physics/set_down.h"
#include "physics/world_model.h"

namespace understudy::physics {
namespace {

// MuJoCo resets the state by itself when it finds one of these, and counts it.
constexpr int kDivergenceWarnings[] = {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC};

using Rotation = Eigen::Map<const Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>>;

Eigen::Vector3d Vector(const mjtNum* x) { return {x[0], x[1], x[2]}; }

// What says whether an equality constraint acts: part of the state since MuJoCo 3.
#if mjVERSION_HEADER < 300
auto* Active(mjModel* model, mjData*) { return model->eq_active; }
#else
auto* Active(mjModel*, mjData* data) { return data->eq_active; }
#endif

}  // namespace

PhysicsWorld::PhysicsWorld(mjcf::ModelHandle model, const robot::RobotSpec& spec)
    : model_(std::move(model)),
      data_(mj_makeData(model_.get())),
      motors_(spec.motors.size()),
      hand_begin_{motors_} {
  FindJoints(spec.motors);
  for (const robot::HandSpec& hand : spec.hands) {
    FindJoints(hand.motors);
    hand_begin_.push_back(q_address_.size());
  }
  q_.resize(q_address_.size());
  dq_.resize(dq_address_.size());
  for (const robot::FootSpec& foot : spec.feet) foot_axis_.push_back(foot.axis);
  mj_kinematics(model_.get(), data_.get());
  foot_of_geom_ = FindFeet(*model_, *data_, spec);
  base_body_ = Body(spec.base_body);
  clamp_ = mj_name2id(model_.get(), mjOBJ_EQUALITY, kClampName);
  if (!has_fixed_base()) {
    const int joint = model_->body_jntadr[base_body_];
    base_q_ = model_->jnt_qposadr[joint];
    base_dq_ = model_->jnt_dofadr[joint];
  }
  imu_ = FindImu(spec.imu.site, kImuGyroName, kImuAccelName);
  secondary_imu_ = FindImu(spec.imu.secondary_site, kSecondaryGyroName, kSecondaryAccelName);
  mj_forward(model_.get(), data_.get());
  ReadKinematics();
}

void PhysicsWorld::Reset(const robot::PoseSpec& pose) {
  mj_resetData(model_.get(), data_.get());
  Clamp(false);
  if (!has_fixed_base()) {
    mjtNum* base = data_->qpos + base_q_;
    const mjtNum position[3] = {0, 0, pose.height};
    mju_copy3(base, position);
    mju_copy4(base + 3, pose.quat.data());
    mju_normalize4(base + 3);
  }
  for (std::size_t i = 0; i < motors_; ++i) data_->qpos[q_address_[i]] = pose.q[i];
  if (!has_fixed_base()) {
    data_->qpos[base_q_ + 2] += LiftOntoGround(*model_, data_.get(), base_body_, base_q_);
  }
  mj_forward(model_.get(), data_.get());
  ReadKinematics();
}

void PhysicsWorld::BeginStep() {
  mj_step1(model_.get(), data_.get());
  ReadKinematics();
}

void PhysicsWorld::DriveHand(std::size_t hand, std::span<const double> tau) {
  const std::span<const int> address = OfHand(hand, dq_address_);
  for (std::size_t i = 0; i < address.size(); ++i) data_->qfrc_applied[address[i]] = tau[i];
}

StepHealth PhysicsWorld::EndStep(std::span<const double> tau) {
  for (std::size_t i = 0; i < motors_; ++i) data_->qfrc_applied[dq_address_[i]] = tau[i];
  mj_step2(model_.get(), data_.get());
  mju_zero(data_->xfrc_applied, 6 * static_cast<int>(model_->nbody));
  StepHealth health = StepHealth::kFine;
  for (const int warning : kDivergenceWarnings) {
    if (data_->warning[warning].number != 0) health = StepHealth::kDiverged;
    data_->warning[warning].number = 0;
  }
  return health;
}

void PhysicsWorld::AddForce(int body, const Eigen::Vector3d& p_WP, const Eigen::Vector3d& force_W) {
  const Eigen::Vector3d arm = p_WP - Vector(data_->xipos + 3 * body);
  const Eigen::Vector3d torque = arm.cross(force_W);
  mjtNum* wrench = data_->xfrc_applied + 6 * body;
  mju_addTo3(wrench, force_W.data());
  mju_addTo3(wrench + 3, torque.data());
}

void PhysicsWorld::Clamp(bool on) {
  if (has_fixed_base()) return;
  Active(model_.get(), data_.get())[clamp_] = on;
  if (!on) return;
  // eq_data of a weld: anchor in the second body (the world), the same point in the first (the
  // base), attitude of the second in the first, scale. The point is the base's own origin: one far
  // away would turn the little that the attitude gives way into metres of lever.
  mjtNum* pose = model_->eq_data + mjNEQDATA * clamp_;
  mju_copy3(pose, data_->qpos + base_q_);
  mju_zero3(pose + 3);
  mju_negQuat(pose + 6, data_->qpos + base_q_ + 3);
}

bool PhysicsWorld::clamped() const {
  return has_fixed_base() || Active(model_.get(), data_.get())[clamp_] != 0;
}

int PhysicsWorld::FindBody(const std::string& name) const {
  return mj_name2id(model_.get(), mjOBJ_BODY, name.c_str());
}

Eigen::Vector3d PhysicsWorld::CenterOfMass(int body) const {
  return Vector(data_->xipos + 3 * body);
}

int PhysicsWorld::Body(const std::string& name) const {
  const int body = FindBody(name);
  if (body < 0) throw ModelError("the model has no body '" + name + "'");
  return body;
}

PointReading PhysicsWorld::Point(int body, const Eigen::Vector3d& p_BP) const {
  PointReading point;
  const Rotation R_WB(data_->xmat + 9 * body);
  const Eigen::Vector3d offset = R_WB * p_BP;
  point.p_WP = Vector(data_->xpos + 3 * body) + offset;
  mjtNum velocity[6];  // angular, linear, at the body's origin, world axes
  mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, body, velocity, 0);
  point.v_WP_W = Vector(velocity + 3) + Vector(velocity).cross(offset);
  return point;
}

double PhysicsWorld::tilt() const {
  return std::acos(std::clamp(data_->xmat[9 * base_body_ + 8], -1.0, 1.0));
}

void PhysicsWorld::FootForces(std::span<double> force) const {
  std::fill(force.begin(), force.end(), 0.0);
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    for (const int geom : {contact.geom1, contact.geom2}) {
      const int foot = foot_of_geom_[static_cast<std::size_t>(geom)];
      if (foot < 0) continue;
      mjtNum wrench[6];  // in the contact's frame, whose first axis is the normal
      mj_contactForce(model_.get(), data_.get(), i, wrench);
      const Eigen::Vector3d& axis = foot_axis_[static_cast<std::size_t>(foot)];
      const Rotation R_WB(data_->xmat + 9 * model_->geom_bodyid[geom]);
      const double share = axis.isZero() ? 1 : std::abs(Vector(contact.frame).dot(R_WB * axis));
      force[static_cast<std::size_t>(foot)] += share * wrench[0];
    }
  }
}

double PhysicsWorld::weight() const {
  return model_->body_subtreemass[base_body_] * mju_norm3(model_->opt.gravity);
}

PhysicsWorld::ImuAddress PhysicsWorld::FindImu(const std::string& site, const char* gyro,
                                               const char* accel) const {
  if (site.empty()) return {};
  const auto address = [this](const char* name) {
    return model_->sensor_adr[mj_name2id(model_.get(), mjOBJ_SENSOR, name)];
  };
  return {mj_name2id(model_.get(), mjOBJ_SITE, site.c_str()), address(gyro), address(accel)};
}

robot::ImuReading PhysicsWorld::Read(const ImuAddress& address) const {
  robot::ImuReading imu;
  if (address.site < 0) return imu;
  mjtNum quat[4];
  mju_mat2Quat(quat, data_->site_xmat + 9 * address.site);
  imu.R_WI = Eigen::Quaterniond(quat[0], quat[1], quat[2], quat[3]);
  imu.w_WI_I = Vector(data_->sensordata + address.gyro);
  imu.f_WI_I = Vector(data_->sensordata + address.accel);
  // MuJoCo 3 has the accelerometer of a body that cannot move at 0.
  if (model_->body_weldid[model_->site_bodyid[address.site]] == 0) {
    imu.f_WI_I = imu.R_WI.conjugate() * -Vector(model_->opt.gravity);
  }
  return imu;
}

void PhysicsWorld::FindJoints(const std::vector<robot::MotorSpec>& motors) {
  for (const robot::MotorSpec& motor : motors) {
    const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, motor.joint.c_str());
    q_address_.push_back(model_->jnt_qposadr[joint]);
    dq_address_.push_back(model_->jnt_dofadr[joint]);
  }
}

void PhysicsWorld::ReadKinematics() {
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q_[i] = data_->qpos[q_address_[i]];
    dq_[i] = data_->qvel[dq_address_[i]];
  }
  if (has_fixed_base()) {
    base_.p_WB = Vector(data_->xpos + 3 * base_body_);
    return;
  }
  base_.p_WB = Vector(data_->qpos + base_q_);
  base_.v_WB_W = Vector(data_->qvel + base_dq_);
}

}  // namespace understudy::physics
