#include "motion/humanoid/walk_body.h"

#include <algorithm>
#include <cmath>

#include "mjcf/eigen_views.h"

namespace understudy::motion {
namespace {

constexpr std::size_t kLeastLeg = 5, kMostLeg = 6;  // joints
constexpr double kAlongAxis = 0.8;  // of the axis of a joint that pitches, to the left, or rolls
constexpr double kSlowRate = 0.1;   // rad/s, under which dry friction is not all there: assumed

Eigen::Map<Eigen::VectorXd> Rates(const mjModel& model, const mjcf::DataHandle& data) {
  return {data->qvel, model.nv};
}

}  // namespace

WalkBody::WalkBody(const mjModel& model, const robot::RobotSpec& spec, const BodyModel& soles)
    : bones_(model),
      data_(mjcf::MakeDataWithoutContacts(model)),
      mass_(soles.mass()),
      gravity_(soles.gravity()),
      base_body_(mj_name2id(&model, mjOBJ_BODY, spec.base_body.c_str())),
      M_(model.nv, model.nv),
      bias_(model.nv),
      imu_J_(6, model.nv) {
  for (const robot::MotorSpec& motor : spec.motors) {
    const int joint = mj_name2id(&model, mjOBJ_JOINT, motor.joint.c_str());
    joints_.push_back(joint);
    dofs_.push_back(model.jnt_dofadr[joint]);
    q_addresses_.push_back(model.jnt_qposadr[joint]);
    limits_.push_back(motor.torque_limit);
  }
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    const BodyModel::Foot& foot = soles.feet()[i];
    soles_[i] = {.body = foot.body, .centre = foot.centre};
    soles_[i].R << foot.forward, foot.up.cross(foot.forward), foot.up;
    feet_[i].J.setZero(6, model.nv);
  }
  FindLegs(spec);
  FindImu(spec);
  bones_.ngeom = 0;
  const bool free = model.body_jntnum[base_body_] == 1;
  const auto walks = [](const Foot& foot) {
    return foot.knee >= 0 && foot.motors.size() >= kLeastLeg && foot.motors.size() <= kMostLeg;
  };
  can_walk_ =
      free && std::ranges::all_of(feet_, walks) && feet_[0].motors.size() == feet_[1].motors.size();
  if (!free) return;
  base_dof_ = model.jnt_dofadr[model.body_jntadr[base_body_]];
  base_q_ = model.jnt_qposadr[model.body_jntadr[base_body_]];
  mju_zero3(data_->qpos + base_q_);
}

void WalkBody::FindLegs(const robot::RobotSpec& spec) {
  for (const int address : q_addresses_) data_->qpos[address] = 0;
  mj_kinematics(&bones_, data_.get());
  const mjcf::RotationView R_WB(data_->xmat + 9 * base_body_);
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    Foot& foot = feet_[i];
    std::vector<int> pitching;
    for (int body = soles_[i].body; body > base_body_; body = bones_.body_parentid[body]) {
      const auto motor = std::ranges::find_if(
          joints_, [&](int joint) { return bones_.jnt_bodyid[joint] == body; });
      if (motor == joints_.end()) continue;
      const auto place = static_cast<int>(motor - joints_.begin());
      foot.motors.insert(foot.motors.begin(), place);
      const Eigen::Vector3d axis = R_WB.transpose() * mjcf::Vector(data_->xaxis + 3 * *motor);
      if (std::abs(axis.x()) > kAlongAxis) foot.hip_roll = place;
      if (std::abs(axis.y()) > kAlongAxis) pitching.insert(pitching.begin(), place);
    }
    // Hip, knee, ankle.
    if (pitching.size() == 3) {
      foot.hip_pitch = pitching[0];
      foot.knee = pitching[1];
    }
    if (foot.knee >= 0) {
      foot.bend = spec.standing.q[static_cast<std::size_t>(foot.knee)] < 0 ? -1 : 1;
    }
    const Eigen::Vector3d hip = R_WB.transpose() * (mjcf::Vector(data_->xpos + 3 * soles_[i].body) -
                                                    mjcf::Vector(data_->xpos + 3 * base_body_));
    foot.side = hip.y() < 0 ? -1 : 1;
  }
}

void WalkBody::FindImu(const robot::RobotSpec& spec) {
  imu_site_ = mj_name2id(&bones_, mjOBJ_SITE, spec.imu.site.c_str());
  for (int body = bones_.site_bodyid[imu_site_]; body > base_body_;
       body = bones_.body_parentid[body]) {
    Link link{.turn = mjcf::Quaternion(bones_.body_quat + 4 * body)};
    const auto motor =
        std::ranges::find_if(joints_, [&](int joint) { return bones_.jnt_bodyid[joint] == body; });
    if (motor != joints_.end()) {
      link.motor = static_cast<int>(motor - joints_.begin());
      link.axis = mjcf::Vector(bones_.jnt_axis + 3 * *motor);
    }
    chain_.insert(chain_.begin(), link);
  }
  R_LI_ = mjcf::Quaternion(bones_.site_quat + 4 * imu_site_);
}

void WalkBody::PlaceBase(std::span<const double> dq, const robot::ImuReading& imu) {
  Eigen::Quaterniond R_BI(1, 0, 0, 0);
  Eigen::Vector3d joints{0, 0, 0};  // the IMU's rate against the base, in the base
  for (const Link& link : chain_) {
    R_BI = R_BI * link.turn;
    if (link.motor < 0) continue;
    const auto motor = static_cast<std::size_t>(link.motor);
    joints += dq[motor] * (R_BI * link.axis);
    R_BI = R_BI * Eigen::AngleAxisd(data_->qpos[q_addresses_[motor]], link.axis);
  }
  R_BI = R_BI * R_LI_;
  const Eigen::Quaterniond R_WB = (imu.R_WI * R_BI.conjugate()).normalized();
  const Eigen::Vector3d w_WB_B = R_BI * imu.w_WI_I - joints;
  R_WB_ = R_WB.toRotationMatrix();
  w_WB_W_ = R_WB_ * w_WB_B;
  const std::array quat{R_WB.w(), R_WB.x(), R_WB.y(), R_WB.z()};
  std::ranges::copy(quat, data_->qpos + base_q_ + 3);
  mju_zero3(data_->qvel + base_dof_);
  mju_copy3(data_->qvel + base_dof_ + 3, w_WB_B.data());
}

void WalkBody::Update(std::span<const double> q, std::span<const double> dq,
                      const robot::ImuReading& imu) {
  mjData* const d = data_.get();
  for (std::size_t i = 0; i < q.size(); ++i) {
    d->qpos[q_addresses_[i]] = q[i];
    d->qvel[dofs_[i]] = dq[i];
  }
  PlaceBase(dq, imu);
  mj_kinematics(&bones_, d);
  mj_comPos(&bones_, d);
  mj_crb(&bones_, d);
  mj_comVel(&bones_, d);
  mj_rne(&bones_, d, 0, bias_.data());
#if mjVERSION_HEADER < 300
  mj_fullM(&bones_, M_.data(), d->qM);
#else
  mj_fullM(&bones_, d, M_.data());
#endif
  std::fill_n(d->qacc, bones_.nv, 0.0);
  mj_rnePostConstraint(&bones_, d);  // accelerations of the bodies
  ReadFeet();

  com_ = mjcf::Vector(d->subtree_com + 3 * base_body_);
  const Eigen::Matrix<double, 6, 1> momentum = M_.middleRows<6>(base_dof_) * Rates(bones_, data_);
  com_velocity_ = momentum.head<3>() / mass_;
  momentum_ = R_WB_ * momentum.tail<3>();
  mj_jac(&bones_, d, imu_J_.data(), nullptr, d->site_xpos + 3 * imu_site_,
         bones_.site_bodyid[imu_site_]);
  imu_velocity_ = imu_J_.topRows<3>() * Rates(bones_, data_);
}

void WalkBody::ReadFeet() {
  mjData* const d = data_.get();
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    Foot& foot = feet_[i];
    const SoleFrame& sole = soles_[i];
    const mjcf::RotationView R_WF(d->xmat + 9 * sole.body);
    const Eigen::Vector3d arm = R_WF * sole.centre;
    foot.p = mjcf::Vector(d->xpos + 3 * sole.body) + arm;
    foot.R = R_WF * sole.R;
    mj_jac(&bones_, d, foot.J.data(), foot.J.data() + 3 * bones_.nv, foot.p.data(), sole.body);
    const Eigen::Matrix<double, 6, 1> velocity = foot.J * Rates(bones_, data_);
    foot.v = velocity.head<3>();
    foot.w = velocity.tail<3>();
    std::array<mjtNum, 6> a{};  // about the body's origin: turn, then way; gravity counts as lift
    mj_objectAcceleration(&bones_, d, mjOBJ_XBODY, sole.body, a.data(), 0);
    foot.dw0 = mjcf::Vector(a.data());
    foot.a0 = mjcf::Vector(a.data() + 3) + mjcf::Vector(bones_.opt.gravity) + foot.dw0.cross(arm) +
              foot.w.cross(foot.w.cross(arm));
  }
}

double WalkBody::Friction(std::size_t motor, double dq) const {
  const int dof = dofs_[motor];
  return bones_.dof_frictionloss[dof] * std::tanh(dq / kSlowRate) + bones_.dof_damping[dof] * dq;
}

}  // namespace understudy::motion
