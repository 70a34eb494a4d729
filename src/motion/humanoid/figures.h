// What follows from how a humanoid is built: its postures on the ground, and the stiffness of its
// joints.
#pragma once

#include <span>
#include <vector>

#include "motion/humanoid/body_model.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// What standing in one posture comes to, on flat soles.
struct StandFigures {
  double com_height = 0;   // m over the soles
  double base_height = 0;  // m
  double pitch = 0;        // rad, of the base
};

// Of the posture `q` [rad]. Leaves `body` in it.
StandFigures StandOf(std::span<const double> q, BodyModel* body);

// Of locked joints, in motor order.
struct JointGains {
  std::vector<bool> bears;     // whether the motor is of legs or waist
  std::vector<double> kp, kd;  // N·m/rad, N·m·s/rad
};

// Leaves `body` in the robot's standing pose.
JointGains FindGains(const robot::RobotSpec& spec, BodyModel* body);

}  // namespace understudy::motion
