// How far geoms reach.
#ifndef UNDERSTUDY_PHYSICS_GEOM_EXTENT_H_
#define UNDERSTUDY_PHYSICS_GEOM_EXTENT_H_

#include <mujoco/mujoco.h>

namespace understudy {

bool Collides(const mjModel& model, int geom);

// Height [m] in the world of the lowest point of a geom, where `data` has its kinematics. For the
// shapes that may move; for planes and height fields that of their middle.
double LowestPoint(const mjModel& model, const mjData& data, int geom);

}  // namespace understudy

#endif  // UNDERSTUDY_PHYSICS_GEOM_EXTENT_H_
