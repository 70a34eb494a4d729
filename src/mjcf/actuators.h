// Rewrites actuators: limits of joint torque, sensors of joint torque, gains.
#pragma once

#include <vector>

#include "mjcf/joints.h"
#include "mjcf/rewrite.h"

namespace understudy::mjcf {

// actuatorfrcrange of a joint with one actuator of gear g becomes the actuator's forcerange: the
// range divided by g, intersected with the forcerange the actuator has. Exact for qfrc_actuator of
// MuJoCo 3. Of a joint without an actuator it is left out.
//
// Throws ModelError when two actuators drive the joint, when an actuator acts through anything but
// a joint and may drive it, when g is 0, or when the two ranges leave no room.
void LimitActuators(MjcfElement* root, const MjcfDefaults& defaults, MjcfJoints* joints,
                    std::vector<Rewrite>* rewrites);

// jointactuatorfrc becomes actuatorfrc of the joint's one actuator where that has gear 1, else a
// user sensor, which keeps the place in sensordata and reads 0. (So does jointactuatorfrc here:
// MuJoCo's actuators are off.) Name, noise and cutoff stay.
void RenameTorqueSensors(MjcfElement* root, const MjcfDefaults& defaults, MjcfJoints* joints,
                         std::vector<Rewrite>* rewrites);

// A position actuator with kv, dampratio or inheritrange becomes a general one with the same law:
// force = kp (ctrl - length) - kv velocity. dampratio makes kv = 2 dampratio sqrt(kp M / g²) with M
// the joint's inertia in the reference pose (MuJoCo XML reference, position/dampratio).
//
// Throws ModelError when an actuator with dampratio or inheritrange drives no hinge or slide, or
// its joint has no range to inherit; and what compiling throws, where a dampratio needs M.
void SpellOutPositionGains(MjcfElement* root, const MjcfDefaults& defaults, MjcfJoints* joints,
                           std::vector<Rewrite>* rewrites);

}  // namespace understudy::mjcf
