// What a humanoid's motors give beside their springs.
#pragma once

#include <vector>

#include "motion/humanoid/behaviour.h"
#include "motion/humanoid/stand_balance.h"

namespace understudy::motion {

// Torques that carry what hangs from each joint and press the soles on the ground, anew whenever
// the body has been worked out. Behaviours share one, so that what bears the robot goes on where
// one follows another.
class Bearing {
 public:
  explicit Bearing(std::size_t motors) : tau_(motors) {}

  // In each step one of them: as the robot rests, or so that it balances.
  void Rest(const HumanoidReading& sensed);
  void Balance(const HumanoidReading& sensed, const StandGoal& goal);

  double tau(std::size_t motor) const { return tau_[motor]; }  // N·m

 private:
  void Press(const BodyModel& body);

  StandBalance balance_;
  std::vector<double> tau_;
};

}  // namespace understudy::motion
