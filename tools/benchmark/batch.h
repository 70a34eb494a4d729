// What a batch of robots, as a policy is trained in, keeps of MuJoCo's own speed.
#pragma once

#include <vector>

#include "figure.h"

namespace understudy::bench {

struct BatchEffort {
  int robots = 64;
  int rounds = 20;  // of the batch against bare MuJoCo, a second of each robot
};

// Robots that stand by their motors' gains, with states read at 50 Hz, beside a loop of nothing but
// mj_step over the same second of one of them. All in this process, without a network.
std::vector<Figure> MeasureBatch(const BatchEffort& effort);

}  // namespace understudy::bench
