// How well a quadruped's motion service knows how its base moves.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace understudy::bench {

// Nothing of a robot on two feet. Root mean squares of the service's estimate of its base's
// velocity and height less the truth of the same sample, over 10 s of a balanced stand and over
// four pushes of 0.33 m/s, one from each side, with the 2 s that follow each. Simulated, on flat
// ground, with the sensors' own noise.
std::vector<Figure> MeasureEstimate(const std::string& robot);

}  // namespace understudy::bench
