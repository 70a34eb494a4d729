// How fast programs on the simulated clock go, and whether they repeat.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace understudy::bench {

struct ClockEffort {
  double seconds = 60;  // simulated, of a run whose speed is measured
  int speeds = 5;       // such runs
  int pairs = 10;       // of runs that are compared, on a quiet machine and on a busy one each
  int flooded = 100;    // pairs beside floods of UDP
  int rehearsals = 1000;
};

// A program that is measured in place of the C client.
struct ClockedProgram {
  std::string robot = "go2";
  std::vector<std::string> command;  // empty: the C client
  bool released = false;             // without a motion service, as the C client has it
  std::string script;                // file of what happens meanwhile; empty: nothing
  double times = 15;                 // simulated s per s that are wanted
};

// Measures a program: simulated seconds per second of the whole of it, from exec to its end, and
// how many pairs of runs say the same. Of the C client, which commands a Go2 at 500 Hz and listens,
// also the robot without a program against `--speed max`, pairs beside floods of UDP, and a
// campaign of rehearsals of 10 s. Throws std::runtime_error if a run fails.
std::vector<Figure> MeasureClock(const std::string& understudy, const ClockedProgram& program,
                                 const ClockEffort& effort);

}  // namespace understudy::bench
