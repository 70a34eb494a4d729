// What a quadruped's motion service takes while it walks.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace understudy::bench {

// Microseconds of CPU per simulated millisecond, over `seconds` of walking ahead and a little
// aside, so that wheels step too. Empty for a robot without such a service. Measured on a second
// controller beside the one that moves the robot, with the same sensors and goals.
std::vector<Figure> MeasureWalking(const std::string& robot, double seconds);

}  // namespace understudy::bench
