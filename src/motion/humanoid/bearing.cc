#include "motion/humanoid/bearing.h"

namespace understudy::motion {

void Bearing::CarryWeight(const HumanoidReading& sensed) {
  if (sensed.since_worked_out == 0) return;
  balance_.CarryWeight(sensed.body, sensed.load);
  Press(sensed.body);
}

void Bearing::Balance(const HumanoidReading& sensed, const StandGoal& goal) {
  if (sensed.since_worked_out == 0) return;
  balance_.Step(sensed.body, goal, sensed.load, sensed.since_worked_out);
  Press(sensed.body);
}

void Bearing::Press(const BodyModel& body) {
  for (std::size_t i = 0; i < tau_.size(); ++i) tau_[i] = body.GravityTorque(i);
  for (std::size_t foot = 0; foot < 2; ++foot) {
    const GroundReaction& ground = balance_.reactions()[foot];
    body.AddGroundReaction(foot, ground.force, ground.moment, tau_);
  }
}

}  // namespace understudy::motion
