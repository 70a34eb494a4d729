// Computes extents of geoms.
#pragma once

#include "mjcf/mujoco_handles.h"

namespace understudy::physics {

// Whether it meets others by its bits or in a <pair>.
bool Collides(const mjModel& model, int geom);

// Returns how far [m] a geom extends from its origin along a unit vector in its frame. 0 for planes
// and height fields, which cannot move.
double Reach(const mjModel& model, int geom, const double direction[3]);

// Returns the world height [m] of a geom's lowest point for the kinematics in `data`; for planes
// and height fields that of their origin.
double LowestPoint(const mjModel& model, const mjData& data, int geom);

}  // namespace understudy::physics
