// Decides what the motors of a hand follow.
#ifndef UNDERSTUDY_AUTHORITY_HAND_GATE_H_
#define UNDERSTUDY_AUTHORITY_HAND_GATE_H_

#include <cstdint>
#include <span>
#include <vector>

#include "authority/command_gate.h"
#include "robot/robot_spec.h"

namespace understudy::authority {

// Takes commands to a hand or refuses them with a reason. Before the first one its motors are
// locked, as they are when a command says so: they brake with spec.lock_kd. After that each motor
// follows its last taken command for as long as nobody sends another, unless that command had it
// watched: then it locks once spec.timeout has passed without a taken command, and stays locked
// until a command that does not have it watched ("must be cleared with 0": Dex3-1 page,
// hardware_contract 1.5). That a motor which has timed out locks rather than goes limp is
// *assumed*.
//
// No motion service holds a hand: commands count at any time. Lenient lets pass what is wrong in
// form (motor mode), but not a command with other than one entry per motor.
class HandGate {
 public:
  // `spec` must outlive the gate.
  HandGate(const robot::HandSpec& spec, bool lenient);

  // Offers a command that arrived at time t [s]; `wire` is what the port found wrong with its form.
  // Returns kNone when taken, else the reason. A refused command changes nothing but the counts.
  robot::Refusal Offer(const robot::HandCommand& command, robot::Refusal wire, double t);

  // What each motor follows at time t [s], not before the last call's t, in motor order. All are
  // enabled: a locked one is told to brake. Valid until the next call.
  std::span<const robot::MotorCommand> Current(double t);

  bool locked(std::size_t motor) const { return motors_[motor].locked; }
  bool timed_out(std::size_t motor) const { return motors_[motor].timed_out; }

  // As before the first command, counts kept.
  void Restart();

  // `timeouts` counts how often commands stopped, however many motors were watched.
  const GateCounts& counts() const { return counts_; }

 private:
  struct Motor {
    bool locked = true;
    bool watched = false;
    bool timed_out = false;
  };

  void Lock(std::size_t motor);

  const robot::HandSpec& spec_;
  bool lenient_;
  std::vector<Motor> motors_;
  std::vector<robot::MotorCommand> current_;
  GateCounts counts_;
  double taken_at_ = 0;
};

}  // namespace understudy::authority

#endif  // UNDERSTUDY_AUTHORITY_HAND_GATE_H_
