#include "motion/humanoid/walk_estimator.h"

#include <algorithm>
#include <cmath>

namespace understudy::motion {
namespace {

// Assumed, tried on every robot here with noise, delay and low friction.
constexpr double kCorrection = 0.1;    // s in which resting soles correct the velocity
constexpr double kLeanRate = 6;        // 1/s², of the velocity's correction into the attitude's
constexpr double kMostLean = 0.08;     // rad
constexpr double kTurnTime = 0.005;    // s over which the soles' rates are smoothed
constexpr double kDoubtfulTurn = 0.4;  // rad/s at which a sole counts half

Eigen::Matrix3d HeadingOf(const Eigen::Matrix3d& R) {
  return Eigen::AngleAxisd(std::atan2(R(1, 0), R(0, 0)), Eigen::Vector3d::UnitZ())
      .toRotationMatrix();
}

}  // namespace

robot::ImuReading WalkEstimator::Corrected(const robot::ImuReading& imu) const {
  robot::ImuReading corrected = imu;
  const Eigen::Vector3d lean = HeadingOf(imu.R_WI.toRotationMatrix()) * lean_;
  const double angle = lean.norm();
  if (angle > 0) corrected.R_WI = Eigen::AngleAxisd(-angle, lean / angle) * imu.R_WI;
  return corrected;
}

void WalkEstimator::Begin(const WalkBody& body, std::size_t stance) {
  stance_ = stance;
  planted_.setZero();
  p_WB_ = -body.feet()[stance].p;
  v_WB_ = -(body.feet()[0].v + body.feet()[1].v) / 2;
  v_WI_ = v_WB_ + body.imu_velocity();
  turning_.fill(Eigen::Vector3d::Zero());
  lean_.setZero();
}

void WalkEstimator::Step(const WalkBody& body, const robot::ImuReading& imu,
                         const std::array<double, 2>& resting, double trust, double dt) {
  Eigen::Vector3d by_soles{0, 0, 0};
  for (std::size_t i = 0; i < resting.size(); ++i) {
    by_soles -= resting[i] * body.feet()[i].v;
    turning_[i] += dt / (dt + kTurnTime) * (body.feet()[i].w - turning_[i]);
  }
  const double turn = turning_[stance_].norm() / kDoubtfulTurn;
  const Eigen::Vector3d gravity(0, 0, body.gravity());
  v_WI_ += (imu.R_WI * imu.f_WI_I - gravity) * dt;
  v_WB_ = v_WI_ - body.imu_velocity();
  const Eigen::Vector3d missing = trust / (1 + turn * turn) * dt * (by_soles - v_WB_);
  v_WB_ += missing / kCorrection;
  // A lean of the attitude makes gravity count as acceleration.
  Eigen::Vector3d leans = kLeanRate / body.gravity() *
                          HeadingOf(imu.R_WI.toRotationMatrix()).transpose() *
                          Eigen::Vector3d(missing.y(), -missing.x(), 0);
  if (body.rolls()) leans.x() = 0;  // soles that roll do not rest sideways
  lean_ += leans;
  lean_ = lean_.cwiseMin(kMostLean).cwiseMax(-kMostLean);
  v_WI_ = v_WB_ + body.imu_velocity();
  p_WB_ = planted_ - body.feet()[stance_].p;
}

void WalkEstimator::Plant(const WalkBody& body, std::size_t foot) {
  planted_ = Foot(body, foot);
  planted_.z() = 0;
  stance_ = foot;
  p_WB_ = planted_ - body.feet()[foot].p;
}

}  // namespace understudy::motion
