#include "sensors/odometer.h"

#include <cmath>

namespace understudy::sensors {
namespace {

using Eigen::Vector2d;

// The unit vector of its heading.
Vector2d HeadingOf(const Eigen::Quaterniond& R_WI) {
  return (R_WI * Eigen::Vector3d::UnitX()).head<2>().normalized();
}

}  // namespace

Odometer::Odometer(const SensorConfig& config, double dt)
    : dt_(dt),
      drawn_(Drawn(config.seed, "odometer.scale", "x", 1),
             Drawn(config.seed, "odometer.scale", "y", 1)),
      noise_(config.seed, kOdometerStream) {
  Apply(config);
}

void Odometer::Apply(const SensorConfig& config) {
  scale_ = config.odometer.scale * drawn_;
  walk_ = config.odometer.walk * std::sqrt(dt_);
}

void Odometer::Restart(const robot::BaseReading& truth) {
  off_.setZero();
  told_ = truth;
}

void Odometer::Step(const robot::BaseReading& truth, const Eigen::Quaterniond& R_WI,
                    const Eigen::Quaterniond& told_R_WI) {
  // Each error is added to the truth, so that without any the reading is the truth bit for bit.
  const Vector2d v = truth.v_WB_W.head<2>();
  const Vector2d ahead = HeadingOf(R_WI), left(-ahead.y(), ahead.x());
  Vector2d told = v + scale_.x() * ahead.dot(v) * ahead + scale_.y() * left.dot(v) * left;
  if (told_R_WI.coeffs() != R_WI.coeffs()) {
    const Vector2d told_ahead = HeadingOf(told_R_WI);
    told = Vector2d(ahead.dot(told), left.dot(told));
    told = told.x() * told_ahead + told.y() * Vector2d(-told_ahead.y(), told_ahead.x());
  }
  off_ += dt_ * (told - v);
  for (int i = 0; i < 2 && walk_ > 0; ++i) off_[i] += walk_ * noise_();
  told_ = truth;
  told_.v_WB_W.head<2>() = told;
  told_.p_WB.head<2>() += off_;
}

}  // namespace understudy::sensors
