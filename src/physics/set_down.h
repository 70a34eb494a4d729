// Finds the height at which a robot stands on the ground.
#pragma once
#include "mjcf/mujoco_handles.h"

namespace understudy::physics {

// Returns how far [m] to raise the robot of `base_body`, whose free joint begins at qpos[base_q],
// so that its lowest colliding point has the same height over the ground as it now has over z = 0:
// 0 for a robot that stands, more for one that hangs. Exactly 0 over ground at z = 0, negative over
// lower ground.
//
// The ground is the highest immovable surface below the lowest place where the robot touches
// nothing: a robot in a room gets onto its floor, one inside a hill onto the hill. Returns 0 if
// there is no ground within 20 m below or no free place within 100 m above, and without a search
// where contacts are disabled. Ignores bodies that can move.
//
// Restores qpos; `data` then needs mj_forward. Allocates nothing.
double LiftOntoGround(const mjModel& model, mjData* data, int base_body, int base_q);

}  // namespace understudy::physics
