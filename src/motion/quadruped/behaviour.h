// What a quadruped's legs can be busy with.
#pragma once

#include "motion/quadruped/body.h"

namespace understudy::motion {

// What the legs are to do: angles, their rates, and torques that carry the body.
struct LegCommand {
  PerLeg q, dq, tau;  // rad, rad/s, N·m
};

// Leads the legs from its beginning until it is over or another one begins. Each has a Begin of its
// own, which takes what was sensed last and what it needs besides. A gait will be one of them.
// Allocates nothing after its constructor.
class Behaviour {
 public:
  virtual ~Behaviour() = default;

  // One step of dt [s]. `legs` is what the last step of any behaviour said.
  virtual void Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) = 0;

  virtual bool over() const = 0;
};

}  // namespace understudy::motion
