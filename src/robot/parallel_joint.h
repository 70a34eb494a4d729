// Maps two serial joints (pitch, roll) to the two motors (A, B) that drive them together: ankles
// and waist of the humanoids.
#pragma once

#include "robot/robot_spec.h"

namespace understudy::robot {

// A linear differential, *assumed* (the linkage's lengths are not published; exact at the zero pose
// of a symmetric mechanism):  A = pitch + ratio · roll,  B = pitch - ratio · roll.  Torques map by
// the transpose, so power is the same on both sides. On the wire slot `pitch` carries B and slot
// `roll` carries A (docs/dev/sources.md#parallel-pairs).
class ParallelJoint {
 public:
  struct Serial {
    double pitch = 0;
    double roll = 0;
  };
  struct Motors {
    double a = 0;
    double b = 0;
  };

  explicit ParallelJoint(const ParallelSpec& spec) : spec_(spec) {}

  // Maps angles or rates.
  Motors ToMotors(const Serial& x) const {
    return {x.pitch + spec_.roll_ratio * x.roll, x.pitch - spec_.roll_ratio * x.roll};
  }
  Serial TorqueToSerial(const Motors& tau) const {
    return {tau.a + tau.b, spec_.roll_ratio * (tau.a - tau.b)};
  }
  Motors TorqueToMotors(const Serial& tau) const {
    return {(tau.pitch + tau.roll / spec_.roll_ratio) / 2,
            (tau.pitch - tau.roll / spec_.roll_ratio) / 2};
  }

  int pitch() const { return spec_.pitch; }
  int roll() const { return spec_.roll; }

 private:
  ParallelSpec spec_;
};

}  // namespace understudy::robot
