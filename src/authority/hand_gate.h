// Decides which command the motors of a hand follow.
#pragma once

#include <cstdint>

#include "authority/command_gate.h"
#include "robot/robot_spec.h"

namespace understudy::authority {

// Takes commands to a hand or refuses them with a reason. Motors are locked (not enabled) before
// the first command. Then each follows its last taken command without limit, unless that command
// has it watched: then it locks after spec.timeout without a taken command, until a command without
// the watch bit ("must be cleared with 0": [docs] G1 dexterous hand). That a timed-out motor locks
// rather than goes limp is *assumed*.
//
// Motion services do not move hands, so commands are taken at any time.
class HandGate {
 public:
  explicit HandGate(const robot::HandSpec& spec);

  // Takes or refuses a command that arrived at time t [s]. Returns kNone or the reason: kMotorCount
  // for a wrong number of motors, or a harmful value. A refused command changes nothing.
  robot::Refusal Offer(const robot::RobotCommand& command, double t);

  // Returns what the motors follow at time t [s], which must not go back. Valid until the next
  // call.
  const robot::RobotCommand& Current(double t);

  // Returns to the state before the first command.
  void Restart();

  // Returns how often commands have stopped since construction, counted once for all watched
  // motors.
  std::uint64_t timeouts() const { return timeouts_; }

 private:
  double timeout_;
  robot::RobotCommand current_;
  std::uint64_t timeouts_ = 0;
  double taken_at_ = 0;
};

}  // namespace understudy::authority
