// A hand of the robot: what its motors give and what it tells.
#pragma once

#include <span>
#include <vector>

#include "authority/hand_gate.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::emulator {

// Its motors obey the law of the robot's (robot/motor.h) in every step. Not modelled: how they
// warm, what they draw from the battery, encoder lattices (no capture of one is known) and what
// pads feel.
class Hand {
 public:
  // `spec` must outlive the hand.
  explicit Hand(const robot::HandSpec& spec);

  // Torques [N·m] of its motors for angles [rad] and rates [rad/s], all in motor order. Valid until
  // the next call.
  std::span<const double> Step(const robot::RobotCommand& command, std::span<const double> q,
                               std::span<const double> dq);

  // What it tells of the instant of the last Step, with the same q and dq.
  void Sample(const authority::HandGate& gate, std::span<const double> q,
              std::span<const double> dq, robot::HandReading* reading) const;

 private:
  const robot::HandSpec& spec_;
  std::vector<double> torque_;
};

}  // namespace understudy::emulator
