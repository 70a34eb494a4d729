// Soft dark ovals on the ground under what stands on it: MuJoCo has no ambient occlusion, and
// without them feet float.
#pragma once

#include <functional>

#include <mujoco/mujoco.h>

namespace understudy::viewer {

// Adds to the scene an oval for every body that is near ground, the darker the nearer. `of_robots`
// says which geoms robots have; ground is what else cannot move. `data` has the kinematics of the
// state.
void AddContactShadows(const mjModel& model, const mjData& data,
                       const std::function<bool(int geom)>& of_robots, mjvScene* scene);

}  // namespace understudy::viewer
