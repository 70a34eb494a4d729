// What a quadruped's legs can be busy with.
#pragma once

#include "motion/behaviour.h"
#include "motion/quadruped/body.h"

namespace understudy::motion {

// What the legs are to do: angles, their rates, and torques that carry the body.
struct LegCommand {
  PerLeg q, dq, tau;  // rad, rad/s, N·m
};

// Leads the legs.
using Behaviour = BehaviourOf<QuadrupedReading, LegCommand>;

}  // namespace understudy::motion
