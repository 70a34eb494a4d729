// Whether a quadruped keeps on its feet: one run, drawn by its seed.
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
std::span<const TrialGround> TrialGrounds();

struct Trial {
  std::string robot;
  std::string ground;  // of TrialGrounds()
  double push = 0;     // N·s/kg, 0.1 s long, twice a run
  int seed = 0;
};

struct Outcome {
  double fell = -1;       // s into the run; below 0: it kept on its feet
  bool righted = false;   // Recovery Stand got a fallen one up again
  bool got_there = true;  // made half of the way that was asked for, where one is
};

// The push [N·s/kg] that a robot of its kind and size is wanted to take.
double PushOf(const robot::RobotSpec& spec);

// Twelve seconds of being walked and pushed by somebody who sees it, after which it is to come to
// rest on its feet. Friction is 0.4 to 1.2, every body's mass within a fifth of the model's, the
// way from command to torque 10 ms, sensors have their noise. What was drawn is logged. `watch` is
// called after every 20 ms with the time into the run [s] and what was asked for.
using Watch = std::function<void(const MotionRig& rig, double t, const Eigen::Vector3d& wish)>;
Outcome Try(const Trial& trial, const Watch& watch = {});

}  // namespace understudy::motion
