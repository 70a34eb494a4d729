// Sets a robot on ground that is not at height 0.
#pragma once
#include "mjcf/mujoco_handles.h"

namespace understudy::physics {

// How far [m] to raise the robot around `base_body`, whose free joint's position begins at
// qpos[base_q], so that it has the room below it that it would have over ground at z = 0: the
// height of its lowest colliding point, be that 0 for a robot that stands or more for one that
// hangs. Exactly 0 over ground at z = 0, negative over ground that is lower.
//
// The ground is whatever does not move and is met first from above, once the robot stands clear: a
// robot in a room is set on its floor, one inside a hill on the hill. 0 where there is no ground
// within 20 m below or no free place within 100 m above. Bodies that move do not count.
//
// Leaves qpos as it was and `data` otherwise in need of mj_forward. Allocates nothing.
double LiftOntoGround(const mjModel& model, mjData* data, int base_body, int base_q);

}  // namespace understudy::physics
