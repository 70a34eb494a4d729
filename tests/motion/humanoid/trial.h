// Whether a humanoid keeps on its feet.
#pragma once

#include <span>

#include "tests/motion/trial.h"

namespace understudy::motion {

std::span<const TrialGround> HumanoidGrounds();

// The push [N·s/kg] ahead or back that it is wanted to take on that ground; aside two thirds of it.
double HumanoidPush(const std::string& ground);

// A run in its usual walking state, after which it is to stand: a minute on flat ground, elsewhere
// 24 s. Every 5 s it is pushed at the torso, from any side. Friction is 0.5 to 1.2, every body's
// mass within a tenth of the model's, the way from command to torque 5 ms, sensors have their
// noise. What was drawn is logged. A fallen humanoid is not righted.
Outcome TryHumanoid(const Trial& trial, const Watch& watch = {});

}  // namespace understudy::motion
