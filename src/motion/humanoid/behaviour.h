// The behaviours of a humanoid and their readings.
#pragma once

#include <array>
#include <span>

#include "motion/behaviour.h"
#include "motion/humanoid/body_model.h"
#include "robot/robot_values.h"

namespace understudy::motion {

// The readings of one step.
struct HumanoidReading {
  std::span<const double> q, dq;   // rad, rad/s, motor order
  robot::ImuReading imu{};         // of LowState
  std::array<bool, 2> contacts{};  // whether each foot bears load, in RobotSpec::feet order
  double load = 0;                 // share of the weight that the feet bear, 0 to 1
  // Updated only in some steps.
  const BodyModel& body;
  // s since the previous update in a step that updates it, else 0.
  double since_worked_out = 0;
};

// A behaviour sets the whole command of every motor.
using HumanoidBehaviour = BehaviourOf<HumanoidReading, robot::RobotCommand>;

}  // namespace understudy::motion
