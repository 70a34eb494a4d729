#include "sensors/attitude_filter.h"

#include <cmath>

namespace understudy::sensors {
namespace {

constexpr double kGravity = 9.81;  // m/s²
// Share of gravity by which a specific force may differ from it and still tells the vertical: in
// flight and at impacts it does not. *assumed*
constexpr double kCredible = 0.5;

// The rotation by a vector [rad] that is short, to the third order.
Eigen::Quaterniond ShortTurn(const Eigen::Vector3d& turn) {
  const double square = turn.squaredNorm() / 4;
  const Eigen::Vector3d axis = (0.5 - square / 12) * turn;
  return {1 - square / 2, axis.x(), axis.y(), axis.z()};
}

}  // namespace

void AttitudeFilter::Restart(const Eigen::Quaterniond& R_WI, const Eigen::Vector3d& f_WI_I) {
  const Eigen::Vector3d up_I = R_WI.conjugate() * Eigen::Vector3d::UnitZ();
  R_WI_ = R_WI;
  correction_.setZero();
  if (f_WI_I.norm() > 0) R_WI_ = R_WI * Eigen::Quaterniond::FromTwoVectors(f_WI_I, up_I);
}

void AttitudeFilter::Step(const Eigen::Vector3d& w_WI_I, const Eigen::Vector3d& f_WI_I) {
  Eigen::Vector3d rate = w_WI_I + correction_;
  const double norm = f_WI_I.norm();
  if (std::abs(norm - kGravity) < kCredible * kGravity) {
    const Eigen::Vector3d up_I = R_WI_.conjugate() * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d error = f_WI_I.cross(up_I) / norm;
    rate += gain_ * error;
    correction_ += trim_ * dt_ * error;
  }
  R_WI_ = (R_WI_ * ShortTurn(dt_ * rate)).normalized();
}

}  // namespace understudy::sensors
