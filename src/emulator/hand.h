// A hand of the robot: what it is told, what its motors give and what it tells.
#ifndef UNDERSTUDY_EMULATOR_HAND_H_
#define UNDERSTUDY_EMULATOR_HAND_H_

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
  // `spec` must outlive the hand. `lenient` as in HandGate.
  Hand(const robot::HandSpec& spec, bool lenient);

  // As HandGate::Offer.
  robot::Refusal Offer(const robot::HandCommand& command, robot::Refusal wire, double t);

  // Torques [N·m] of its motors for angles [rad] and rates [rad/s] of the instant t [s], all in
  // motor order. Valid until the next call.
  std::span<const double> Step(std::span<const double> q, std::span<const double> dq, double t);

  // What it tells of the instant of the last Step, with the same q and dq.
  void Sample(std::span<const double> q, std::span<const double> dq,
              robot::HandReading* reading) const;

  void Restart() { gate_.Restart(); }

  const authority::GateCounts& counts() const { return gate_.counts(); }
  robot::Refusal last_refusal() const { return last_refusal_; }

 private:
  const robot::HandSpec& spec_;
  authority::HandGate gate_;
  std::vector<double> torque_;
  robot::Refusal last_refusal_ = robot::Refusal::kNone;
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_EMULATOR_HAND_H_
