// How long a command takes to show in the robot's state, and a robot to appear.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace understudy::bench {

// From a write of rt/lowcmd to the first rt/lowstate that shows its torque, at a client, `samples`
// times at random phases of the robot's period; in turns with the round trip of the same messages
// through a process that only sends them back. The daemon runs at real time.
std::vector<Figure> MeasureLatency(const std::string& understudy, const std::string& robot,
                                   int samples);

// From exec to the first rt/lowstate at a client that was there before, on flat ground: the median
// of `rounds`.
Figure MeasureStart(const std::string& understudy, const std::string& robot, int rounds);

// Memory of a running robot after `seconds`.
std::vector<Figure> MeasureMemory(const std::string& understudy, const std::string& robot,
                                  double seconds);

}  // namespace understudy::bench
