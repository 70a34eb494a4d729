// How contacts are computed, for the whole of a world.
#pragma once

#include <mujoco/mujoco.h>

namespace understudy::physics {

// Computes contacts with pyramids in place of friction cones, without the impedance ratio and the
// torsional and rolling friction that the robot's file asks for: a Go2 steps several times as fast.
// Feet creep more under load. A robot whose file says nothing of it has such contacts already, but
// for torsional friction.
void UsePyramids(mjModel* model);

}  // namespace understudy::physics
