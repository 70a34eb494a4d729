// Poses a clamped robot joint by joint, as if by hand.
#pragma once

#include <cstddef>
#include <vector>

#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::drive {

// Overrides the commands to single motors of the body for a time: each goes to its angle at kSpeed
// and stays there. Allocates only in the constructor. Times are simulated, s.
class JointRig {
 public:
  static constexpr double kSpeed = 1;  // rad/s, *assumed*: slow enough to be stopped

  // Moves with the gains hold_kp and hold_kd of the motors.
  explicit JointRig(const robot::RobotSpec& spec);

  // Moves a motor from its angle `q` [rad] to `to`, or on from where it has been moved, until t.
  void Move(std::size_t motor, double to, double q, double until);
  void Release();

  // Returns `command` with the moved motors' own in it, for a step of dt at t. Valid until the next
  // call.
  const robot::RobotCommand& Over(const robot::RobotCommand& command, double t, double dt);

 private:
  struct Joint {
    robot::MotorCommand command;  // with the gains, at the angle that it has come to
    double to = 0;                // rad
    double until = 0;             // s
    bool moved = false;
  };

  std::vector<Joint> joints_;
  std::size_t moved_ = 0;
  robot::RobotCommand out_;
};

}  // namespace understudy::drive
