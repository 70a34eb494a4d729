#include "motion/quadruped/body.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace understudy::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

}  // namespace

QuadrupedBody::QuadrupedBody(const QuadrupedFigures& figures)
    : legs_{QuadrupedLeg(figures.legs[0]), QuadrupedLeg(figures.legs[1]),
            QuadrupedLeg(figures.legs[2]), QuadrupedLeg(figures.legs[3])},
      trunk_(figures.trunk),
      trunk_shapes_(figures.trunk_shapes),
      R_BI_(figures.R_BI),
      p_BI_(figures.p_BI),
      wheeled_(figures.wheeled),
      mass_(figures.mass),
      gravity_(figures.gravity) {}

QuadrupedReading QuadrupedBody::Read(const authority::MotionInput& input) const {
  QuadrupedReading reading;
  Vector3d moment = trunk_.mass * trunk_.com;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) {
    for (std::size_t i = 0; i < 3; ++i) {
      const robot::MotorReading& motor = input.motors[3 * leg + i];
      reading.q[leg][static_cast<Eigen::Index>(i)] = motor.q;
      reading.dq[leg][static_cast<Eigen::Index>(i)] = motor.dq;
    }
    reading.places[leg] = legs_[leg].Place(reading.q[leg]);
    reading.feet[leg] = reading.places[leg].foot;
    const Vector3d& dq = reading.dq[leg];
    reading.feet_speed[leg] = FootJacobian(reading.places[leg]) * dq;
    const double wheel = wheeled_ ? input.motors[12 + leg].dq : 0;
    reading.turn[leg] =
        dq[0] * Vector3d::UnitX() + (dq[1] + dq[2] + wheel) * reading.places[leg].R_hip.col(1);
    reading.foot_force[leg] = input.foot_force[leg];
    moment += legs_[leg].MassMoment(reading.places[leg]);
  }
  reading.com = moment / mass_;
  const Matrix3d& R_WB = reading.R_WB =
      (input.imu.R_WI * R_BI_.conjugate()).normalized().toRotationMatrix();
  const double yaw = std::atan2(R_WB(1, 0), R_WB(0, 0));
  reading.R_TB = Eigen::AngleAxisd(-yaw, Vector3d::UnitZ()).toRotationMatrix() * R_WB;
  reading.up = R_WB.row(2).transpose();
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) {
    reading.soles[leg] = legs_[leg].Sole(reading.places[leg], reading.up);
  }
  reading.w_WB_B = R_BI_ * input.imu.w_WI_I;
  reading.f_WI_B = R_BI_ * input.imu.f_WI_I;
  return reading;
}

PerLeg QuadrupedBody::Angles(const PerLeg& feet) const {
  PerLeg q;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) q[leg] = legs_[leg].Angles(feet[leg]);
  return q;
}

bool QuadrupedBody::Reach(const PerLeg& feet, PerLeg* q) const {
  bool all = true;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) {
    all = legs_[leg].Reach(feet[leg], &(*q)[leg]) && all;
  }
  return all;
}

double QuadrupedBody::Depth(const Vector3d& up) const {
  double depth = 0;
  for (const TrunkShape& shape : trunk_shapes_) {
    const double half = up.cwiseAbs().dot(shape.box.sizes()) / 2 + shape.rounding;
    depth = std::max(depth, half - up.dot(shape.box.center()));
  }
  return depth;
}

Matrix3d QuadrupedBody::Inertia(const QuadrupedReading& reading) const {
  Matrix3d inertia = trunk_.inertia + PointInertia(trunk_.mass, trunk_.com - reading.com);
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) {
    inertia += legs_[leg].InertiaAbout(reading.places[leg], reading.com);
  }
  return inertia;
}

// Forces s along `up` with sum m g and no moment about the centre of mass: A s = b. With the
// diagonal matrix W of loads, s = W A' (A W A')^-1 b has the least sum of squares over load.
std::array<double, 4> QuadrupedBody::FootForces(const QuadrupedReading& reading,
                                                const std::array<double, 4>& load) const {
  const Vector3d side = reading.up.cross(Vector3d::UnitX()).normalized();
  const Vector3d ahead = side.cross(reading.up);
  Eigen::Matrix<double, 3, 4> a;
  Eigen::Matrix<double, 4, 3> wat;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) {
    const Vector3d arm = reading.feet[leg] - reading.com;
    const auto column = static_cast<Eigen::Index>(leg);
    a.col(column) = Vector3d(1, arm.dot(ahead), arm.dot(side));
    wat.row(column) = load[leg] * a.col(column).transpose();
  }
  const Matrix3d awat = a * wat + 1e-9 * Matrix3d::Identity();
  const Eigen::Vector4d force = wat * awat.ldlt().solve(Vector3d(mass_ * gravity_, 0, 0));
  std::array<double, 4> forces{};
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) {
    forces[leg] = std::clamp(force[static_cast<Eigen::Index>(leg)], 0.0, mass_ * gravity_);
  }
  return forces;
}

PerLeg QuadrupedBody::SupportTorque(const QuadrupedReading& reading,
                                    const std::array<double, 4>& load, double share) const {
  const std::array<double, 4> force = FootForces(reading, load);
  PerLeg torque;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) {
    torque[leg] = legs_[leg].HoldingTorque(reading.places[leg], reading.up, gravity_) -
                  share * force[leg] * FootJacobian(reading.places[leg]).transpose() * reading.up;
  }
  return torque;
}

}  // namespace understudy::motion
