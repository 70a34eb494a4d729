// Simulates short windows of recordings: from the measured state, by the recorded commands.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "identify/samples.h"
#include "physics/bench.h"
#include "robot/robot_spec.h"

namespace understudy::identify {

// A part of a recording that is simulated by itself.
struct ReplayWindow {
  const Samples* samples = nullptr;
  std::size_t first = 0, count = 0;  // states, the first of which is where it starts
  JointState start{};
};

// Cuts a recording into windows of `seconds`, one after the other, for steps of `timestep` [s].
// Those with a pause of more than 50 ms between two states, or without a command at their start,
// are left out; none starts where the state is not known well, at the ends of the recording and
// beside such a pause (IsAmongStates).
std::vector<ReplayWindow> WindowsOf(const Samples& samples, double seconds, double timestep);

// The figures of a simulation.
struct Figures {
  robot::RobotSpec spec{};
  double delay = 0;            // s from a command to its torque; below 0: before it was recorded
  std::vector<double> mass{};  // factors on the links' masses, in motor order
};

// Several benches, one for each thread.
class Replay {
 public:
  // Throws as physics::Bench.
  Replay(const physics::PlacedRobot& robot, const std::filesystem::path& scene, double timestep,
         int threads);

  double timestep() const { return timestep_; }  // s
  std::size_t motors() const { return motors_; }
  const physics::Bench& bench() const { return *benches_.front(); }

  // Writes the angles [rad] that the simulation has less those recorded, of windows in order: by
  // state after the first and motor. 0 where an angle is not known, or once the physics diverged
  // kDiverged. `out` has ResidualsOf(windows) numbers. One set of figures after the other, each
  // with its own `out`. Returns false if a signal asked to stop, with `out` unfinished.
  bool Run(std::span<const Figures> figures, std::span<const ReplayWindow> windows,
           std::span<double* const> out) const;

  Eigen::Index ResidualsOf(std::span<const ReplayWindow> windows) const;

 private:
  static constexpr double kDiverged = 1;  // rad

  void Simulate(physics::Bench* bench, const Figures& figures, const ReplayWindow& window,
                double* out) const;

  std::size_t motors_;
  double timestep_;
  std::vector<std::unique_ptr<physics::Bench>> benches_;
};

}  // namespace understudy::identify
