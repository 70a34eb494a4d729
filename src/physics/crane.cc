#include "physics/crane.h"

#include <algorithm>

namespace understudy::physics {
namespace {

// m, assumed; the winch stops here, so that a taut strap always has a direction.
constexpr double kShortest = 0.05;
// N·s/m of both straps, assumed: a robot of 35 kg stops swinging within some seconds.
constexpr double kSwingDamping = 80;

}  // namespace

void Crane::Attach(const Hooks& hooks, double weight) {
  const double stretch = weight / config_.stiffness;
  for (std::size_t i = 0; i < hooks.size(); ++i) {
    p_WA_[i] = hooks[i].p_WP + Eigen::Vector3d(0, 0, config_.length + stretch);
  }
  length_ = config_.length;
  to_pay_out_ = 0;
  attached_ = true;
}

Crane::Pulls Crane::Step(const Hooks& hooks, double dt) {
  tension_ = 0;
  Pulls pulls{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  if (!attached_) return pulls;
  const double move = std::clamp(to_pay_out_, -config_.speed * dt, config_.speed * dt);
  length_ += move;
  to_pay_out_ -= move;
  if (length_ < kShortest) {  // cancels the rest of the motion
    length_ = kShortest;
    to_pay_out_ = 0;
  }
  for (std::size_t i = 0; i < hooks.size(); ++i) {
    const Eigen::Vector3d strap = p_WA_[i] - hooks[i].p_WP;
    const double distance = strap.norm();
    if (distance <= length_) continue;
    const Eigen::Vector3d up = strap / distance;
    const double rate = -up.dot(hooks[i].v_WP_W);
    const double tension = (config_.stiffness * (distance - length_) + config_.damping * rate) / 2;
    if (tension <= 0) continue;
    const Eigen::Vector3d swing = hooks[i].v_WP_W + rate * up;
    pulls[i] = tension * up - kSwingDamping / 2 * swing;
    tension_ += tension;
  }
  return pulls;
}

}  // namespace understudy::physics
