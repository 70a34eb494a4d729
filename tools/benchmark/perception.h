// What it costs to see.
#pragma once

#include <vector>

#include "figure.h"

namespace understudy::bench {

// Microseconds of CPU per ray of a standing Go2's lidar, by its own tracer and by mj_ray, and the
// share of a core that all of the lidar takes without sending: on flat ground, and in a row of
// rough ground, boxes, obstacles and stairs. Over `clouds` clouds.
std::vector<Figure> MeasurePerception(int clouds);

}  // namespace understudy::bench
