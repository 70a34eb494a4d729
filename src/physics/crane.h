// Models the crane from which humanoids hang.
#pragma once

#include <array>

#include "physics/mujoco_world.h"

namespace understudy::physics {

struct CraneConfig {
  double length = 0.6;       // m of tether between anchor and hook at the start
  double stiffness = 20000;  // N/m, of both straps together
  double damping = 1000;     // N·s/m, of both straps together, only while one is taut
  double speed = 0.1;        // m/s at which it is lowered or raised
};

// Two elastic straps side by side, so that the robot does not turn, each between a fixed anchor and
// a hook on the robot. A strap pulls or is slack, and never pushes:
//
//   tension = max(0, stiffness / 2 · (|hook - anchor| - length) + damping / 2 · d|hook -
//   anchor|/dt) when longer than length
//
// A taut strap also damps the swing of its hook. Figures are *assumed*: a stiff webbing sling over
// the robot's shoulders.
class Crane {
 public:
  explicit Crane(const CraneConfig& config) : config_(config) {}

  // Both hooks, left and right.
  using Hooks = std::array<PointReading, 2>;
  using Pulls = std::array<Eigen::Vector3d, 2>;

  // Distance [m] of the hooks from the middle; *assumed*.
  static constexpr double kHookOffset = 0.12;

  // Attaches the straps straight above the hooks' present positions, with a tension of `weight`
  // [N].
  void Attach(const Hooks& hooks, double weight);
  void Release() {
    attached_ = false;
    tension_ = 0;
  }
  // Lowers by `by` [m] at the configured speed; a negative value raises, until the hook is 5 cm
  // from the anchor. Adds to earlier calls.
  void Lower(double by) { to_pay_out_ += by; }

  // Moves the winch for one step of dt [s] and returns the pulls [N] on the hooks, world axes.
  Pulls Step(const Hooks& hooks, double dt);

  // Takes speed and damping of `config`, by neither of which a robot that hangs is moved.
  void Apply(const CraneConfig& config) {
    config_.speed = config.speed;
    config_.damping = config.damping;
  }

  bool attached() const { return attached_; }
  double length() const { return length_; }  // m, unloaded
  // N, of both straps in the last step; 0 when not attached.
  double tension() const { return tension_; }
  // Returns the middle between the anchors [m, world]; meaningless before the first Attach.
  Eigen::Vector3d anchor() const { return (p_WA_[0] + p_WA_[1]) / 2; }

 private:
  CraneConfig config_;
  bool attached_ = false;
  std::array<Eigen::Vector3d, 2> p_WA_{Eigen::Vector3d::Zero(),
                                       Eigen::Vector3d::Zero()};  // anchors
  double length_ = 0;
  double to_pay_out_ = 0;
  double tension_ = 0;
};

}  // namespace understudy::physics
