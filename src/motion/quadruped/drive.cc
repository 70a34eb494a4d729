#include "motion/quadruped/drive.h"

namespace understudy::motion {

using Eigen::Vector3d;

namespace {

// All assumed, found by trying in simulation.
constexpr double kCatchUp = 2;          // 1/s, of a way that is missing
constexpr double kTurnGain = 2;         // of a turn rate that is missing
constexpr double kTurnCatchUp = 4;      // 1/s, of an angle
constexpr double kMostMissing = 0.5;    // m
constexpr double kMostMissingTurn = 2;  // rad: most of a turn on the spot is slip
constexpr double kRest = 0.05;          // m/s and rad/s

}  // namespace

Vector3d RollingVelocity(const QuadrupedReading& sensed) {
  Vector3d v(0, 0, 0);
  for (std::size_t leg = 0; leg < sensed.turn.size(); ++leg) {
    v += (sensed.w_WB_B + sensed.turn[leg]).cross(-sensed.soles[leg]) / 4;
  }
  return sensed.R_WB * v;
}

void Drive::Begin() {
  wish_.Begin();
  missing_.setZero();
  rates_.fill(0);
  over_ = false;
}

void Drive::Ask(const Vector3d& velocity) { wish_.Ask({velocity.x(), 0, velocity.z()}); }

void Drive::Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) {
  wish_.Step(dt);
  stance_->Step(sensed, dt, legs);
  const Vector3d& wanted = wish_.velocity();
  const Vector3d v_T = sensed.R_TB * sensed.R_WB.transpose() * estimator_.v_WB_W();
  const Vector3d error(wanted.x() - v_T.x(), 0, wanted.z() - (sensed.R_TB * sensed.w_WB_B).z());
  const Vector3d most(kMostMissing, 0, kMostMissingTurn);
  missing_ = (missing_ + dt * error).cwiseMax(-most).cwiseMin(most);
  const double ahead = wanted.x() + kCatchUp * missing_.x();
  const double turn =
      spec_.turn_scrub * wanted.z() + kTurnGain * error.z() + kTurnCatchUp * missing_.z();
  for (std::size_t leg = 0; leg < rates_.size(); ++leg) {
    const double side = (sensed.R_TB * sensed.feet[leg]).y();
    rates_[leg] = (ahead - turn * side) / body_.radius();
  }
  over_ = wish_.at_rest() && error.isZero(kRest);
}

}  // namespace understudy::motion
