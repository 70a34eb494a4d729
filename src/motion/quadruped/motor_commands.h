// Motor commands of a quadruped.
#pragma once

#include <array>
#include <cstddef>

#include "motion/quadruped/behaviour.h"
#include "robot/motion_spec.h"
#include "robot/robot_values.h"

namespace understudy::motion {

// Every motor only brakes, with `kd` [N·m·s/rad].
void Brake(double kd, robot::RobotCommand* command);

// The legs' motors, the first twelve. All is said by q alone, with dq and tau 0: so a real Go2 does
// while it stands. The motor law makes the same torque of it.
void CommandLegs(const LegCommand& legs, double kp, double kd, robot::RobotCommand* command);

// The motors of wheels, FR FL RR RL: they run, stay where they are on the ground, or brake softly.
// Other robots have none.
class WheelCommands {
 public:
  explicit WheelCommands(const robot::QuadrupedMotionSpec& figures) : figures_(figures) { LetGo(); }

  // What stays in place from now on is where it is then.
  void LetGo() { held_.fill(robot::kNoPosition); }

  robot::MotorCommand Free() const { return Told(0, 0, 0); }
  // `rate` [rad/s] against the calf.
  robot::MotorCommand Run(std::size_t leg, double rate);
  // Keeps its angle against the world: `q` [rad] is that against the calf and `carried` how far
  // body, thigh and calf have turned it forwards.
  robot::MotorCommand Stay(std::size_t leg, double q, double carried);

 private:
  robot::MotorCommand Told(double q, double dq, double kp) const;

  const robot::QuadrupedMotionSpec& figures_;
  std::array<double, 4> held_{};  // rad against the world
};

}  // namespace understudy::motion
