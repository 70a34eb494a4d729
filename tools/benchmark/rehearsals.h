// How fast campaigns of rehearsals go.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace understudy::bench {

// Plays so many rehearsals of 10 s of a robot that only listens, as many side by side as there are
// cores, and tells how many simulated seconds they make in one of a core, and of CPU time. Throws
// std::runtime_error if one fails.
std::vector<Figure> MeasureRehearsals(const std::string& understudy, const std::string& robot,
                                      int runs);

}  // namespace understudy::bench
