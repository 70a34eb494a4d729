#include "drive/gears.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace understudy::drive {
namespace {

constexpr double kLeastArmature = 1e-4;  // kg·m², of models that have none; *assumed*

}  // namespace

Gears::Gears(const robot::RobotSpec& spec, std::span<const double> armature, double dt)
    : dt_(dt),
      half_(spec.dynamics.backlash / 2),
      ripple_(spec.dynamics.ripple),
      periods_(spec.dynamics.ripple_periods),
      armature_(armature.begin(), armature.end()),
      ahead_(armature.size()),
      rate_(armature.size()),
      torque_(armature.size()),
      q_(armature.size()),
      dq_(armature.size()) {
  for (double& one : armature_) one = std::max(one, kLeastArmature);
}

std::span<const double> Gears::Step(std::span<const double> torque, std::span<const double> q) {
  for (std::size_t i = 0; i < torque_.size(); ++i) {
    const double swing = ripple_ == 0 ? 0 : ripple_ * std::sin(periods_ * (q[i] + ahead_[i]));
    torque_[i] = Pass(i, torque[i] * (1 + swing));
  }
  return torque_;
}

// What of a motor's torque its joint gets.
double Gears::Pass(std::size_t motor, double torque) {
  if (half_ == 0) return torque;
  double& ahead = ahead_[motor];
  double& rate = rate_[motor];
  if (std::abs(ahead) == half_ && torque * ahead >= 0) return torque;
  rate += torque / armature_[motor] * dt_;
  ahead += rate * dt_;
  if (std::abs(ahead) < half_) return 0;
  ahead = std::copysign(half_, ahead);
  const double momentum = armature_[motor] * rate;
  rate = 0;
  return momentum / dt_;
}

void Gears::AddPlay(std::span<const double> q, std::span<const double> dq) {
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q_[i] = q[i] + ahead_[i];
    dq_[i] = dq[i] + rate_[i];
  }
}

void Gears::Restart() {
  std::ranges::fill(ahead_, 0);
  std::ranges::fill(rate_, 0);
}

}  // namespace understudy::drive
