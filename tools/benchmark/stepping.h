// How much of MuJoCo's own speed is left in the whole daemon.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace understudy::bench {

// What a robot does while it is measured.
struct Doing {
  const char* robot;
  const char* start;     // pose
  double ahead = 0;      // -1 to 1, the remote's left stick
  double wanted = 0.95;  // share of bare MuJoCo's speed without a reader
};

// The real program, headless at --speed max and publishing on DDS, beside a loop of nothing but
// mj_step, which goes through the same steps of such a run again with its forces: same compiled
// model, scene and start. Runs one, then the other, `rounds` times for `window` seconds each.
// `listener`: a client reads rt/lowstate meanwhile. The CPU figures leave out the time in which
// other programs had the core.
std::vector<Figure> MeasureStepping(const std::string& understudy, const Doing& doing,
                                    bool listener, int rounds, double window);

}  // namespace understudy::bench
