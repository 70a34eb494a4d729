// Feed-forward torques of a humanoid's motors.
#pragma once

#include <vector>

#include "motion/humanoid/behaviour.h"
#include "motion/humanoid/stand_balance.h"

namespace understudy::motion {

// Computes torques that carry the weight below each joint and press the soles on the ground,
// whenever the body model was updated. Behaviours share one, so that torques continue from one to
// the next.
class Bearing {
 public:
  explicit Bearing(std::size_t motors) : tau_(motors) {}

  // Call one of them in each step: for a robot at rest, or to balance.
  void CarryWeight(const HumanoidReading& sensed);
  void Balance(const HumanoidReading& sensed, const StandGoal& goal);

  double tau(std::size_t motor) const { return tau_[motor]; }  // N·m

 private:
  void Press(const BodyModel& body);

  StandBalance balance_;
  std::vector<double> tau_;
};

}  // namespace understudy::motion
