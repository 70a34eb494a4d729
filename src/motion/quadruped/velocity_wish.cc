#include "motion/quadruped/velocity_wish.h"

#include <algorithm>
#include <cmath>

namespace understudy::motion {

using Eigen::Vector3d;

void VelocityWish::Begin(const Vector3d& velocity) {
  delayed_.fill(Vector3d::Zero());
  velocity_ = velocity;
  acceleration_.setZero();
}

Vector3d VelocityWish::Taken(const Vector3d& wish) const {
  const Vector3d cut = wish.cwiseMax(spec_.least_speed).cwiseMin(spec_.most_speed);
  const bool none = (cut.cwiseAbs().array() <= spec_.dead_band.array()).all();
  if (none) return {0, 0, 0};
  constexpr double kMostAside =
      2;  // m/s², assumed: half of what ground with a friction of 0.4 holds
  const double aside = cut.head<2>().norm() * std::abs(cut.z());
  return aside > kMostAside ? Vector3d(std::sqrt(kMostAside / aside) * cut) : cut;
}

void VelocityWish::Step(double dt) {
  const auto late = static_cast<std::size_t>(std::lround(spec_.dead_time / dt));
  delayed_[next_] = wish_;
  const Vector3d& due = delayed_[(next_ + kDelayed - std::min(late, kDelayed - 1)) % kDelayed];
  next_ = (next_ + 1) % kDelayed;
  constexpr double kHurried = 0.4;  // of the time constant, assumed
  const Vector3d lag = (hurries_ ? kHurried : 1) * spec_.time_constant;
  acceleration_ = (spec_.gain.cwiseProduct(due) - velocity_).cwiseQuotient(lag.cwiseMax(dt));
  acceleration_ = acceleration_.cwiseMax(-most_).cwiseMin(most_);
  velocity_ += dt * acceleration_;
}

bool VelocityWish::at_rest() const {
  constexpr double kUnmoved = 0.02;  // of what follows the wish, m/s and rad/s; assumed
  return wish_.isZero(0) && velocity_.isZero(kUnmoved);
}

}  // namespace understudy::motion
