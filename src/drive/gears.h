// A motor's torque on its way to the joint: torque ripple and backlash of the gears.
#pragma once

#include <span>
#include <vector>

#include "robot/robot_spec.h"

namespace understudy::drive {

// The shafts of all motors of a robot against their joints. All of it is *assumed*.
//
// Ripple. The torque of a motor swings by the share robot.dynamics.ripple, ripple_periods times in
// a turn of its joint, as its magnets and teeth pass.
//
// Backlash. A shaft turns freely against its joint within robot.dynamics.backlash. Where its torque
// pushes it against the end that it is at, the joint gets all of it. Where it does not, the rotor's
// inertia alone takes it, until the shaft comes to the other end; there the joint gets what
// momentum it has come by, without a rebound. The encoder sits on the shaft.
//
// Joints of a parallel pair have each a play of their own. Allocates only in the constructor.
class Gears {
 public:
  // `armature` [kg·m²] is the rotor's inertia at each joint, in motor order like all below; `dt`
  // [s] the time between steps.
  Gears(const robot::RobotSpec& spec, std::span<const double> armature, double dt);

  // Whether torques come as they are and shafts turn as their joints do.
  bool ideal() const { return ripple_ == 0 && half_ == 0; }

  // Takes the torques of the motors [N·m] at joint angles q [rad] and returns those of the joints,
  // valid until the next call.
  std::span<const double> Step(std::span<const double> torque, std::span<const double> q);
  // Adds to angles [rad] and rates [rad/s] of the joints by how much shafts are ahead of them.
  void AddPlay(std::span<const double> q, std::span<const double> dq);
  // As of the last AddPlay: of the shafts.
  std::span<const double> q() const { return q_; }
  std::span<const double> dq() const { return dq_; }

  // Forgets where the shafts were: in the middle of their play.
  void Restart();

 private:
  double Pass(std::size_t motor, double torque);

  double dt_, half_, ripple_, periods_;  // s, rad: half of the play, share, per turn
  std::vector<double> armature_, ahead_, rate_, torque_, q_, dq_;
};

}  // namespace understudy::drive
