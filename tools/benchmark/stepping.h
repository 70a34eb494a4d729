// How much of MuJoCo's own speed is left in the whole daemon.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "figure.h"

namespace understudy::bench {

// How often and how long it is measured.
struct Rounds {
  int count = 40;
  double window = 0.2;           // s each
  std::int64_t settle = 60'000;  // steps before the first, until it stands, hangs or walks evenly
};

// What a robot does while it is measured.
struct Doing {
  const char* robot;
  const char* start;           // pose
  const char* hands = "none";  // robot.hand_make
  double ahead = 0;            // -1 to 1, the remote's left stick
  double wanted = 0.95;        // share of bare MuJoCo's speed without a reader
};

// The real program, headless at --speed max and publishing on DDS, beside a loop of nothing but
// mj_step, which goes through the same steps of such a run again with its forces: same compiled
// model, scene and start. Runs one, then the other, in each round. `listener`: a client reads
// rt/lowstate meanwhile. The CPU figures leave out the time in which other programs had the core.
std::vector<Figure> MeasureStepping(const std::string& understudy, const Doing& doing,
                                    bool listener, const Rounds& rounds);

// Measures what a second robot of that kind adds to the CPU time of a step, as a share of that of a
// robot alone. Both stand, as fast as possible.
Figure MeasureFurtherRobot(const std::string& understudy, const std::string& robot,
                           const Rounds& rounds);

}  // namespace understudy::bench
