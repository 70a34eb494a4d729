// The crane that humanoids hang from.
#pragma once

#include "physics/world.h"

namespace understudy::physics {

struct CraneConfig {
  double length = 0.6;       // m of tether between anchor and hook at the start
  double stiffness = 20000;  // N/m
  double damping = 1000;     // N·s/m, only while the tether is taut
  double speed = 0.1;        // m/s at which it is lowered or raised
};

// An elastic tether between a fixed anchor and a hook on the robot. It pulls or is slack; it never
// pushes:
//
//   tension = max(0, stiffness · (|hook - anchor| - length) + damping · d|hook - anchor|/dt)   when
//   longer than length
//
// Figures are *assumed*: a stiff webbing sling.
class Crane {
 public:
  explicit Crane(const CraneConfig& config) : config_(config) {}

  // Hangs the hook, which is at p_WH [m] now, from straight above with the tether carrying `weight`
  // [N].
  void Attach(const Eigen::Vector3d& p_WH, double weight);
  void Release() {
    attached_ = false;
    tension_ = 0;
  }
  // Pays out `by` [m] at the configured speed; negative raises, until the hook is 5 cm from the
  // anchor. Adds to what is still to be paid out.
  void Lower(double by) { to_pay_out_ += by; }

  // The pull [N] on the hook, world axes, and one step of dt [s] of the winch.
  Eigen::Vector3d Step(const PointReading& hook, double dt);

  bool attached() const { return attached_; }
  double length() const { return length_; }    // m, unloaded
  double tension() const { return tension_; }  // N, of the last step; 0 when not attached
  // m, world; means nothing before the first Attach.
  const Eigen::Vector3d& anchor() const { return p_WA_; }

 private:
  CraneConfig config_;
  bool attached_ = false;
  Eigen::Vector3d p_WA_{0, 0, 0};  // anchor
  double length_ = 0;
  double to_pay_out_ = 0;
  double tension_ = 0;
};

}  // namespace understudy::physics
