// Whether a robot keeps on its feet: one run, drawn by its seed.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "tests/motion/rig.h"

namespace understudy::motion {

// One kind of ground and what is asked for there.
struct TrialGround {
  std::string name;
  std::string about;
};

struct Trial {
  std::string robot;
  std::string ground;  // the name of a TrialGround
  double push = 0;     // N·s/kg, 0.1 s long
  int seed = 0;
  std::string policy{};  // the definition that walks a quadruped; "": the robot's own controller
};

struct Outcome {
  double fell = -1;       // s into the run; below 0: it kept on its feet
  bool righted = false;   // Recovery Stand got a fallen one up again
  bool got_there = true;  // made half of the way that was asked for, where one is
};

// Called after every 20 ms with the time into the run [s] and what was asked for.
using Watch = std::function<void(const MotionRig& rig, double t, const Eigen::Vector3d& wish)>;

}  // namespace understudy::motion
