// Derives figures of a humanoid from its model: postures on the ground and gains of its joints.
#pragma once

#include <span>
#include <vector>

#include "motion/humanoid/body_model.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// The figures of standing in one posture on flat soles.
struct StandFigures {
  double com_height = 0;   // m over the soles
  double base_height = 0;  // m
  double pitch = 0;        // rad, of the base
};

// Computes those of the posture `q` [rad]. Leaves `body` in it.
StandFigures StandOf(std::span<const double> q, BodyModel* body);

// Gains of locked joints, in motor order.
struct JointGains {
  std::vector<bool> bears;     // whether the motor belongs to a leg or the waist
  std::vector<double> kp, kd;  // N·m/rad, N·m·s/rad
};

// Computes them. Leaves `body` in the robot's standing pose.
JointGains FindGains(const robot::RobotSpec& spec, BodyModel* body);

}  // namespace understudy::motion
