// Measures how far geoms reach.
#pragma once

#include "mjcf/mujoco_handles.h"

namespace understudy::physics {

bool Collides(const mjModel& model, int geom);

// How far [m] a geom reaches from its origin in a direction, a unit vector in its own frame. For
// the shapes that may move; 0 for planes and height fields.
double Reach(const mjModel& model, int geom, const double direction[3]);

// Height [m] in the world of the lowest point of a geom, where `data` has its kinematics. For the
// shapes that may move; for planes and height fields that of their middle.
double LowestPoint(const mjModel& model, const mjData& data, int geom);

}  // namespace understudy::physics
