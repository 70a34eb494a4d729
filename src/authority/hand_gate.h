// Decides what the motors of a hand follow.
#pragma once

#include <cstdint>

#include "authority/command_gate.h"
#include "robot/robot_spec.h"

namespace understudy::authority {

// Takes commands to a hand or refuses them with a reason. Before the first one its motors are
// locked, as they are when a command says so: they are not enabled. After that each motor
// follows its last taken command for as long as nobody sends another, unless that command had it
// watched: then it locks once spec.timeout has passed without a taken command, and stays locked
// until a command that does not have it watched ("must be cleared with 0": [docs] G1
// dexterous hand). That a motor which has timed out locks rather than goes limp is
// *assumed*.
//
// No motion service holds a hand: commands count at any time.
class HandGate {
 public:
  explicit HandGate(const robot::HandSpec& spec);

  // Offers a command that arrived at time t [s]. Returns kNone when taken, else the reason:
  // kMotorCount for another number of motors, or what would harm. A refused command changes
  // nothing.
  robot::Refusal Offer(const robot::RobotCommand& command, double t);

  // What each motor follows at time t [s], not before the last call's t. Valid until the next call.
  const robot::RobotCommand& Current(double t);

  // As before the first command.
  void Restart();

  // Times that commands stopped, however many motors were watched, since it was made.
  std::uint64_t timeouts() const { return timeouts_; }

 private:
  double timeout_;
  robot::RobotCommand current_;
  std::uint64_t timeouts_ = 0;
  double taken_at_ = 0;
};

}  // namespace understudy::authority
