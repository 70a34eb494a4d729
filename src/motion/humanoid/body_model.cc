#include "motion/humanoid/body_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/eigen_views.h"
#include "physics/feet.h"

namespace understudy::motion {

using mjcf::Vector;

namespace {

// Height [m] over the lowest point within which a foot counts as sole: the vendor's meshes are flat
// to 4 mm.
constexpr double kSoleThickness = 0.004;

// Collects the lowest points of the geoms that touch the ground.
class SoleExtent {
 public:
  void Add(const Eigen::Vector3d& p) {
    if (p.z() < lowest_ - kSoleThickness) low_ = high_ = p.head<2>();
    if (p.z() < lowest_ + kSoleThickness) {
      low_ = low_.cwiseMin(p.head<2>());
      high_ = high_.cwiseMax(p.head<2>());
    }
    lowest_ = std::min(lowest_, p.z());
  }
  bool empty() const { return !std::isfinite(lowest_); }
  Eigen::Vector3d centre() const {
    const Eigen::Vector2d middle = (low_ + high_) / 2;
    return {middle.x(), middle.y(), lowest_};
  }
  Eigen::Vector2d half_size() const { return (high_ - low_) / 2; }

 private:
  double lowest_ = std::numeric_limits<double>::infinity();
  Eigen::Vector2d low_{0, 0}, high_{0, 0};
};

void AddGeom(const mjModel& model, const mjData& data, int geom, SoleExtent* sole) {
  const Eigen::Vector3d centre = Vector(data.geom_xpos + 3 * geom);
  const mjcf::RotationView R(data.geom_xmat + 9 * geom);
  const Eigen::Vector3d size = Vector(model.geom_size + 3 * geom);
  switch (model.geom_type[geom]) {
    case mjGEOM_MESH: {
      const int mesh = model.geom_dataid[geom];
      const float* v = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
      for (int i = 0; i < model.mesh_vertnum[mesh]; ++i, v += 3) {
        sole->Add(centre + R * Eigen::Vector3d(v[0], v[1], v[2]));
      }
      break;
    }
    case mjGEOM_BOX:
      for (const double x : {-1, 1}) {
        for (const double y : {-1, 1}) {
          for (const double z : {-1, 1}) {
            sole->Add(centre + R * size.cwiseProduct(Eigen::Vector3d(x, y, z)));
          }
        }
      }
      break;
    case mjGEOM_CAPSULE:
      for (const double end : {-1, 1}) {
        sole->Add(centre + R.col(2) * (end * size[1]) - Eigen::Vector3d(0, 0, size[0]));
      }
      break;
    default:  // spheres, and shapes close to one
      sole->Add(centre - Eigen::Vector3d(0, 0, size[0]));
  }
}

}  // namespace

BodyModel::BodyModel(const mjModel& model, const robot::RobotSpec& spec)
    : model_(model),
      bones_(model),
      data_(mjcf::MakeDataWithoutContacts(model)),
      base_body_(mj_name2id(&model, mjOBJ_BODY, spec.base_body.c_str())),
      imu_site_(mj_name2id(&model, mjOBJ_SITE, spec.imu.site.c_str())),
      mass_(model.body_subtreemass[base_body_]),
      gravity_(mju_norm3(model.opt.gravity)),
      feet_(spec.feet.size()),
      soles_(spec.feet.size()),
      carried_mass_(static_cast<std::size_t>(model.nbody)),
      carried_com_(static_cast<std::size_t>(model.nbody), Eigen::Vector3d::Zero()) {
  if (spec.feet.empty()) throw ModelError(spec.name + ": no feet to stand on (feet)");
  std::copy_n(model.body_subtreemass, model.nbody, carried_mass_.begin());
  for (const robot::MotorSpec& motor : spec.motors) {
    Joint joint;
    joint.id = mj_name2id(&model, mjOBJ_JOINT, motor.joint.c_str());
    joint.q_address = model.jnt_qposadr[joint.id];
    joint.body = model.jnt_bodyid[joint.id];
    joint.turns_imu = IsBelow(model.site_bodyid[imu_site_], joint.body);
    joints_.push_back(joint);
    data_->qpos[joint.q_address] = 0;
  }
  if (model.body_jntnum[base_body_] == 1) {  // a free joint: origin of the world, upright
    mjtNum* base = data_->qpos + model.jnt_qposadr[model.body_jntadr[base_body_]];
    mju_zero3(base);
    mju_unit4(base + 3);
  }
  mj_kinematics(&model_, data_.get());
  const std::vector<std::vector<int>> geoms = physics::FootGeoms(model_, *data_, spec);
  for (std::size_t i = 0; i < feet_.size(); ++i) FindSole(geoms[i], spec.feet[i].name, i);
  FindInertia();
  bones_.ngeom = 0;
  const std::vector<double> zero(spec.motors.size());
  robot::ImuReading upright;
  upright.R_WI = Eigen::Quaterniond(
      Eigen::Matrix3d(mjcf::RotationView(data_->xmat + 9 * base_body_).transpose() *
                      mjcf::RotationView(data_->site_xmat + 9 * imu_site_)));
  Update(zero, zero, upright);
}

void BodyModel::FindSole(std::span<const int> geoms, const std::string& name, std::size_t foot) {
  SoleExtent extent;
  Foot& f = feet_[foot];
  for (const int geom : geoms) {
    f.body = model_.geom_bodyid[geom];
    AddGeom(model_, *data_, geom, &extent);
  }
  if (extent.empty()) {
    throw ModelError("foot '" + name + "' has no geoms: " + physics::FeetRemedy(foot));
  }
  const mjcf::RotationView R(data_->xmat + 9 * f.body);
  f.centre = R.transpose() * (extent.centre() - Vector(data_->xpos + 3 * f.body));
  f.forward = R.transpose() * Eigen::Vector3d::UnitX();
  f.up = R.transpose() * Eigen::Vector3d::UnitZ();
  soles_[foot].half_length = extent.half_size().x();
  soles_[foot].half_width = extent.half_size().y();
  for (Joint& joint : joints_) {
    if (IsBelow(f.body, joint.body)) joint.foot = static_cast<int>(foot);
  }
}

void BodyModel::FindInertia() {
  mj_comPos(&model_, data_.get());
  mj_crb(&model_, data_.get());
  mj_factorM(&model_, data_.get());
  std::vector<mjtNum> unit(static_cast<std::size_t>(model_.nv)), column(unit.size());
  for (Joint& joint : joints_) {
    const auto dof = static_cast<std::size_t>(model_.jnt_dofadr[joint.id]);
    unit[dof] = 1;
    mj_solveM(&model_, data_.get(), column.data(), unit.data(), 1);
    unit[dof] = 0;
    joint.felt_inertia = 1 / column[dof];
  }
}

bool BodyModel::IsBelow(int body, int ancestor) const {
  while (body != 0 && body != ancestor) body = model_.body_parentid[body];
  return body == ancestor;
}

void BodyModel::ReadPlaces() {
  const Eigen::Vector3d p_WB = Vector(data_->xpos + 3 * base_body_);
  const mjcf::RotationView R_WB(data_->xmat +
                                9 * base_body_);  // of the private data, not of the robot
  const auto in_base = [&](const mjtNum* p) -> Eigen::Vector3d {
    return R_WB.transpose() * (Vector(p) - p_WB);
  };
  for (auto body = static_cast<int>(model_.nbody) - 1; body > 0; --body) {
    carried_com_[static_cast<std::size_t>(body)].setZero();
  }
  for (auto body = static_cast<int>(model_.nbody) - 1; body >= base_body_; --body) {
    const auto b = static_cast<std::size_t>(body);
    carried_com_[b] += model_.body_mass[body] * in_base(data_->xipos + 3 * body);
    if (body > base_body_) {
      carried_com_[static_cast<std::size_t>(model_.body_parentid[body])] += carried_com_[b];
    }
    if (carried_mass_[b] > 0) carried_com_[b] /= carried_mass_[b];
  }
  for (Joint& joint : joints_) {
    joint.axis = R_WB.transpose() * Vector(data_->xaxis + 3 * joint.id);
    joint.anchor = in_base(data_->xanchor + 3 * joint.id);
  }
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    Foot& foot = feet_[i];
    const mjcf::RotationView R_WF(data_->xmat + 9 * foot.body);
    foot.p_BS = in_base(data_->xpos + 3 * foot.body) + R_WB.transpose() * (R_WF * foot.centre);
    const Eigen::Matrix3d R = R_WB_ * R_WB.transpose() * R_WF;
    soles_[i].forward = R * foot.forward;
    soles_[i].up = R * foot.up;
  }
}

void BodyModel::Update(std::span<const double> q, std::span<const double> dq,
                       const robot::ImuReading& imu) {
  for (std::size_t i = 0; i < joints_.size(); ++i) data_->qpos[joints_[i].q_address] = q[i];
  mj_kinematics(&bones_, data_.get());
  const mjcf::RotationView R_WB(data_->xmat + 9 * base_body_);
  const Eigen::Matrix3d R_BI =
      R_WB.transpose() * mjcf::RotationView(data_->site_xmat + 9 * imu_site_);
  R_WB_ = imu.R_WI.toRotationMatrix() * R_BI.transpose();
  ReadPlaces();

  Eigen::Vector3d w_WB_B = R_BI * imu.w_WI_I;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].turns_imu) w_WB_B -= joints_[i].axis * dq[i];
  }
  w_WB_W_ = R_WB_ * w_WB_B;

  // Relative to the base: the middle of the soles, the centre of mass, and their velocities.
  Eigen::Vector3d p_BO{0, 0, 0}, v_BO{0, 0, 0}, v_BC{0, 0, 0};
  const auto feet = static_cast<double>(feet_.size());
  for (const Foot& foot : feet_) p_BO += foot.p_BS / feet;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    const auto body = static_cast<std::size_t>(joint.body);
    v_BC +=
        carried_mass_[body] / mass_ * dq[i] * joint.axis.cross(carried_com_[body] - joint.anchor);
    if (joint.foot < 0) continue;
    const Foot& foot = feet_[static_cast<std::size_t>(joint.foot)];
    v_BO += dq[i] / feet * joint.axis.cross(foot.p_BS - joint.anchor);
  }
  const Eigen::Vector3d p_BC = carried_com_[static_cast<std::size_t>(base_body_)];
  p_OC_ = R_WB_ * (p_BC - p_BO);
  v_OC_ = R_WB_ * (v_BC - v_BO + w_WB_B.cross(p_BC - p_BO));
  p_OB_ = R_WB_ * -p_BO;
  v_OB_ = R_WB_ * (-v_BO - w_WB_B.cross(p_BO));
  for (std::size_t i = 0; i < feet_.size(); ++i) soles_[i].p_OS = R_WB_ * (feet_[i].p_BS - p_BO);
}

double BodyModel::motor_period() const { return model_.opt.timestep; }

double BodyModel::CarriedMass(std::size_t motor) const {
  return carried_mass_[static_cast<std::size_t>(joints_[motor].body)];
}

double BodyModel::WithinRange(std::size_t motor, double q) const {
  const int joint = joints_[motor].id;
  if (model_.jnt_limited[joint] == 0) return q;
  return std::clamp(q, model_.jnt_range[2 * joint], model_.jnt_range[2 * joint + 1]);
}

double BodyModel::GravityTorque(std::size_t motor) const {
  const Joint& joint = joints_[motor];
  const auto body = static_cast<std::size_t>(joint.body);
  const Eigen::Vector3d up_B = R_WB_.row(2).transpose();
  const Eigen::Vector3d lift = carried_mass_[body] * gravity_ * up_B;
  return joint.axis.dot((carried_com_[body] - joint.anchor).cross(lift));
}

void BodyModel::AddGroundReaction(std::size_t foot, const Eigen::Vector3d& force,
                                  const Eigen::Vector3d& moment, std::span<double> tau) const {
  const Eigen::Vector3d force_B = R_WB_.transpose() * force;
  const Eigen::Vector3d moment_B = R_WB_.transpose() * moment;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    if (joint.foot != static_cast<int>(foot)) continue;
    tau[i] -= joint.axis.dot((feet_[foot].p_BS - joint.anchor).cross(force_B) + moment_B);
  }
}

}  // namespace understudy::motion
