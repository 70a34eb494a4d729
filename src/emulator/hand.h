// A hand of the robot: what it is told, what its motors give and what it tells.
#ifndef UNDERSTUDY_EMULATOR_HAND_H_
#define UNDERSTUDY_EMULATOR_HAND_H_

#include <span>
#include <vector>

#include "authority/hand_gate.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy {

// Its motors obey the law of the robot's (robot/motor.h) in every step. Not modelled: how they
// warm, what they draw from the battery, encoder lattices (no capture of one is known) and what
// pads feel.
class Hand {
 public:
  // `spec` must outlive the hand. `lenient` as in HandGate.
  Hand(const HandSpec& spec, bool lenient);

  // As HandGate::Offer.
  Refusal Offer(const HandCommand& command, Refusal wire, double t);

  // Torques [N·m] of its motors for angles [rad] and rates [rad/s] of the instant t [s], all in
  // motor order. Valid until the next call.
  std::span<const double> Step(std::span<const double> q, std::span<const double> dq, double t);

  // What it tells of the instant of the last Step, with the same q and dq.
  void Sample(std::span<const double> q, std::span<const double> dq, HandReading* reading) const;

  void Restart() { gate_.Restart(); }

  const GateCounts& counts() const { return gate_.counts(); }
  Refusal last_refusal() const { return last_refusal_; }

 private:
  const HandSpec& spec_;
  HandGate gate_;
  std::vector<double> torque_;
  Refusal last_refusal_ = Refusal::kNone;
};

}  // namespace understudy

#endif  // UNDERSTUDY_EMULATOR_HAND_H_
