// How much of MuJoCo's own speed is left in the whole daemon.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace understudy::bench {

// The real program, headless at --speed max and publishing on DDS, beside a loop of nothing but
// mj_step, from the state and with the torques in which the same robot has settled: same compiled
// model, scene and start. Runs one, then the other, `rounds` times for `window` seconds each.
// `listener`: a client reads rt/lowstate meanwhile. The CPU figures leave out the time in which
// other programs had the core.
std::vector<Figure> MeasureStepping(const std::string& understudy, const std::string& robot,
                                    const std::string& start, bool listener, int rounds,
                                    double window);

}  // namespace understudy::bench
