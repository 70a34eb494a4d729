// MuJoCo and nothing else, as what the whole program is measured against.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "assembly/simulation.h"
#include "mjcf/mujoco_handles.h"

namespace understudy::bench {

struct Speed {
  double wall = 0;  // steps per s
  double cpu = 0;   // steps per s of CPU of the stepping thread
};

// What the bare loop makes of a step.
enum class Bare {
  kStep,     // mj_step
  kWithImu,  // and what the bodies feel, which MuJoCo computes for an accelerometer
};

// mj_step over the steps of a run, with the forces that acted on each joint in each of them. Which
// steps matters: one that stands takes one iteration of the solver for seconds, then two.
class BareLoop {
 public:
  // `run` must outlive it.
  explicit BareLoop(assembly::Simulation* run);

  // Has the run go on to `from`, and takes down what happens until `to`, both in steps since the
  // start.
  void Follow(std::int64_t from, std::int64_t to);
  // Makes those steps again and again, for so many s.
  Speed Run(Bare what, double window);

 private:
  static constexpr int kSecond = 1000, kTogether = 100;  // steps

  void Step(Bare what);

  assembly::Simulation* run_;
  std::int64_t step_ = 0;
  const mjModel& model_;
  mjcf::DataHandle data_;
  Eigen::MatrixXd states_;  // qpos, qvel and qacc_warmstart of each second
  Eigen::MatrixXd forces_;  // N and N·m, nv by step
  Eigen::Index next_ = 0;
};

}  // namespace understudy::bench
