#include "motion/quadruped/estimator.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

// All assumed: found by trying in simulation, standing, pushed and gesturing.
constexpr double kAcceleration = 0.1;  // m/s² for one second: noise of the specific force
constexpr double kSlip = 0.02;         // m/s for one second: of a foot that stands
constexpr double kPlace = 0.001;       // m, of a foot's place by the joint angles
constexpr double kRate = 0.1;          // m/s, of the velocity by one leg
constexpr double kStartRate = 0.1;     // m/s
constexpr double kSwing = 1e4;         // variances of a foot in the air are as many times larger
constexpr double kUnloaded = 0.03;     // of the robot's weight: less, and the foot is in the air
constexpr double kLoaded = 0.1;        // more, and it stands
constexpr double kFade = 2;            // s, in which a velocity fades that no foot confirms
// Of a robot that rests on its body. The bounds are far above the errors of any sensor profile.
constexpr double kSmooth = 0.1;      // s, time constant of the low pass
constexpr double kStillTurn = 0.1;   // rad/s
constexpr double kStillForce = 3;    // m/s² that the specific force may differ from gravity
constexpr double kRestTime = 0.3;    // s that it has to be so
constexpr double kRestRate = 0.005;  // m/s, of the velocity of a robot that rests

double Squared(double x) { return x * x; }

}  // namespace

void QuadrupedEstimator::Begin(const QuadrupedReading& reading) {
  x_.setZero();
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const auto row = static_cast<Eigen::Index>(leg + 1);
    x_.row(row) = (reading.R_WB * (reading.feet[leg] - body_.p_BI())).transpose();
  }
  turn_ = reading.w_WB_B;
  force_ = reading.f_WI_B;
  rested_ = 0;
  P_.setZero();
  P_.diagonal() << Squared(kStartRate), Vector5::Constant(Squared(kPlace)).head<4>();
  trust_.fill(1);
  p_WB_.setZero();
  Tell(reading, 0);
}

void QuadrupedEstimator::Step(const QuadrupedReading& reading, double dt,
                              const std::array<double, 4>& stands, bool may_rest) {
  const double weight = body_.mass() * body_.gravity();
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const double share = reading.foot_force[leg] / weight;
    trust_[leg] = stands[leg] * std::clamp((share - kUnloaded) / (kLoaded - kUnloaded), 0.0, 1.0);
    u_[leg] = reading.R_WB * (reading.w_WB_B + reading.turn[leg]).cross(-reading.soles[leg]);
  }
  Predict(reading, dt);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const Vector3d arm = reading.feet[leg] - body_.p_BI();
    Correct(static_cast<Eigen::Index>(leg + 1), (reading.R_WB * arm).transpose(), Squared(kPlace));
    if (trust_[leg] == 0) continue;
    const Vector3d v_WI =
        u_[leg] - reading.R_WB * (reading.w_WB_B.cross(arm) + reading.feet_speed[leg]);
    Correct(0, v_WI.transpose(), Squared(kRate) * (1 + (1 - trust_[leg]) * kSwing));
  }
  if (Rests(reading, dt) && may_rest) {
    Correct(0, Eigen::RowVector3d::Zero(), Squared(kRestRate));
    x_.row(0).setZero();  // what the bias of an accelerometer leaves would add up
  }
  Tell(reading, dt);
}

bool QuadrupedEstimator::Rests(const QuadrupedReading& reading, double dt) {
  const double share = std::min(1.0, dt / kSmooth);
  turn_ += share * (reading.w_WB_B - turn_);
  force_ += share * (reading.f_WI_B - force_);
  const bool still =
      turn_.norm() < kStillTurn && std::abs(force_.norm() - body_.gravity()) < kStillForce;
  rested_ = still ? rested_ + dt : 0;
  return rested_ >= kRestTime;
}

void QuadrupedEstimator::Predict(const QuadrupedReading& reading, double dt) {
  const Vector3d a = reading.R_WB * reading.f_WI_B - body_.gravity() * Vector3d::UnitZ();
  const Eigen::RowVector3d way = dt * (x_.row(0) + dt / 2 * a.transpose());
  x_.row(0) += dt * a.transpose();
  const bool flies = std::ranges::all_of(trust_, [](double trust) { return trust == 0; });
  if (flies) x_.row(0) *= 1 - dt / kFade;
  Eigen::Matrix<double, 5, 5> F = Eigen::Matrix<double, 5, 5>::Identity();
  F.col(0).tail<4>().setConstant(-dt);
  P_ = F * P_ * F.transpose();
  P_(0, 0) += Squared(kAcceleration) * dt;
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const auto row = static_cast<Eigen::Index>(leg + 1);
    x_.row(row) += dt * u_[leg].transpose() - way;
    P_(row, row) += Squared(kSlip) * dt * (1 + (1 - trust_[leg]) * kSwing);
  }
}

void QuadrupedEstimator::Correct(Eigen::Index i, const Eigen::RowVector3d& measured,
                                 double variance) {
  const Vector5 column = P_.col(i);
  const Vector5 gain = column / (column[i] + variance);
  x_ += gain * (measured - x_.row(i)).eval();
  P_ -= gain * column.transpose();
}

void QuadrupedEstimator::Tell(const QuadrupedReading& reading, double dt) {
  const Vector3d p_BI_W = reading.R_WB * body_.p_BI();
  v_WB_W_ = x_.row(0).transpose() - (reading.R_WB * reading.w_WB_B).cross(p_BI_W);
  p_WB_ += dt * v_WB_W_;
  const double trust = std::accumulate(trust_.begin(), trust_.end(), 0.0);
  if (trust == 0) {
    height_ += dt * v_WB_W_.z();
    return;
  }
  double depth = 0;
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const double sole = reading.up.dot(reading.soles[leg]);
    depth -= trust_[leg] / trust * (x_(static_cast<Eigen::Index>(leg + 1), 2) + sole);
  }
  height_ = depth - p_BI_W.z();
}

}  // namespace understudy::motion
