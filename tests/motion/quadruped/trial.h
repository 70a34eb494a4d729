// Whether a quadruped keeps on its feet.
#pragma once

#include <span>

#include "tests/motion/trial.h"

namespace understudy::motion {

std::span<const TrialGround> TrialGrounds();

// The push [N·s/kg] that a robot of its kind and size is wanted to take.
double PushOf(const robot::RobotSpec& spec);

// Twelve seconds of being walked and pushed twice by somebody who sees it, after which it is to
// come to rest on its feet. Friction is 0.4 to 1.2, every body's mass within a fifth of the
// model's, the way from command to torque 10 ms, sensors have their noise. What was drawn is
// logged.
Outcome Try(const Trial& trial, const Watch& watch = {});

}  // namespace understudy::motion
