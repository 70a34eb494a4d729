#include "physics/crane.h"

#include <algorithm>

namespace understudy::physics {
namespace {

// m, assumed; the winch stops here, so that a taut tether always has a direction.
constexpr double kShortest = 0.05;

}  // namespace

void Crane::Attach(const Eigen::Vector3d& p_WH, double weight) {
  const double stretch = weight / config_.stiffness;
  p_WA_ = p_WH + Eigen::Vector3d(0, 0, config_.length + stretch);
  length_ = config_.length;
  to_pay_out_ = 0;
  attached_ = true;
}

Eigen::Vector3d Crane::Step(const PointReading& hook, double dt) {
  tension_ = 0;
  if (!attached_) return Eigen::Vector3d::Zero();
  const double move = std::clamp(to_pay_out_, -config_.speed * dt, config_.speed * dt);
  length_ += move;
  to_pay_out_ -= move;
  if (length_ < kShortest) {  // whatever is left to be raised is forgotten
    length_ = kShortest;
    to_pay_out_ = 0;
  }

  const Eigen::Vector3d tether = p_WA_ - hook.p_WP;
  const double distance = tether.norm();
  if (distance <= length_) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d up = tether / distance;
  const double rate = -up.dot(hook.v_WP_W);
  tension_ = std::max(0.0, config_.stiffness * (distance - length_) + config_.damping * rate);
  return tension_ * up;
}

}  // namespace understudy::physics
