#include "motion/quadruped/gait_clock.h"

#include <cmath>

namespace understudy::motion {

void GaitClock::Begin(const GaitTiming& gait, double wait, double phase) {
  gait_ = gait;
  phase_ = phase;
  wait_ = wait;
  halted_ = false;
}

void GaitClock::Advance(double dt, const GaitTiming& gait, bool halt) {
  wait_ -= dt;
  halted_ = halt && all_stand();
  if (all_stand() && gait.offsets != gait_.offsets) {
    gait_ = gait;
    phase_ = 0;
  }
  if (wait_ > 0 || halted_) return;
  const double before = phase_;
  phase_ += dt / gait_.period;
  if (gait.offsets == gait_.offsets && (phase_ >= 1 || (before < 0.5 && phase_ >= 0.5))) {
    gait_ = gait;
  }
  phase_ -= std::floor(phase_);
}

double GaitClock::phase(std::size_t leg) const {
  const double phase = phase_ + gait_.offsets[leg];
  return phase - std::floor(phase);
}

}  // namespace understudy::motion
