// Moves joints of a robot that is held, as somebody does who sets it up.
#pragma once

#include <cstddef>
#include <vector>

#include "robot/robot_values.h"

namespace understudy::emulator {

// Takes single motors from whoever commands them, for a time: each goes to its angle at kSpeed and
// stays there. Allocates only in the constructor. Times are simulated, s.
class JointRig {
 public:
  static constexpr double kSpeed = 1;  // rad/s, *assumed*: slow enough to be stopped

  // `holds` has the gains of each motor that can be moved, in motor order; motors after these
  // cannot. `motors` is the number of all.
  JointRig(const std::vector<robot::MotorCommand>& holds, std::size_t motors);

  // Moves a motor from its angle `q` [rad] to `to`, or on from where it has been moved, until t.
  void Move(std::size_t motor, double to, double q, double until);
  void Release();
  bool moves() const { return moved_ > 0; }

  // Returns `command` with the moved motors' own in it, for a step of dt at t. `command` must be
  // one for joints, not for parallel motors. Valid until the next call.
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

}  // namespace understudy::emulator
