// What a humanoid's body can be busy with.
#pragma once

#include <span>

#include "motion/behaviour.h"
#include "motion/humanoid/body_model.h"
#include "robot/robot_values.h"

namespace understudy::motion {

// What the service knows in a step.
struct HumanoidReading {
  std::span<const double> q;  // rad, motor order
  double load = 0;            // share of the weight that the feet bear, 0 to 1
  // Worked out in some of the steps only.
  const BodyModel& body;
  // s since it was worked out before, in a step in which it was; else 0.
  double since_worked_out = 0;
};

// Says all of the command, to every motor.
using HumanoidBehaviour = BehaviourOf<HumanoidReading, robot::RobotCommand>;

}  // namespace understudy::motion
