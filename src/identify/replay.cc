#include "identify/replay.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "base/signals.h"
#include "robot/motor.h"

namespace understudy::identify {

std::vector<ReplayWindow> WindowsOf(const Samples& samples, double seconds, double timestep) {
  std::vector<ReplayWindow> windows;
  const std::vector<double>& times = samples.times;
  for (std::size_t first = 0; first + 1 < times.size();) {
    if (!IsAmongStates(samples, first)) {
      ++first;
      continue;
    }
    std::size_t end = first + 1;
    bool whole = true;
    while (end < times.size() && times[end] - times[first] <= seconds) {
      whole = whole && times[end] - times[end - 1] <= kLongestPause;
      ++end;
    }
    if (end == times.size()) break;
    if (whole && end - first > 2 && times[first] >= samples.command_times.front()) {
      windows.push_back({.samples = &samples,
                         .first = first,
                         .count = end - first,
                         .start = StateAt(samples, first, timestep)});
    }
    first = end - 1;
  }
  return windows;
}

Replay::Replay(const physics::PlacedRobot& robot, const std::filesystem::path& scene,
               double timestep, int threads)
    : motors_(robot.spec.motors.size()), timestep_(timestep) {
  for (int i = 0; i < threads; ++i) {
    benches_.push_back(std::make_unique<physics::Bench>(robot, scene, timestep));
  }
}

Eigen::Index Replay::ResidualsOf(std::span<const ReplayWindow> windows) const {
  std::size_t count = 0;
  for (const ReplayWindow& window : windows) count += (window.count - 1) * motors_;
  return static_cast<Eigen::Index>(count);
}

void Replay::Simulate(physics::Bench* bench, const Figures& figures, const ReplayWindow& window,
                      double* out) const {
  const Samples& samples = *window.samples;
  physics::RobotBody& body = bench->robot();
  robot::MotorBank motors(figures.spec, timestep_);
  JointState start = window.start;
  for (std::size_t i = 0; i < start.q.size(); ++i) {
    if (std::isfinite(start.q[i])) continue;
    start.q[i] = figures.spec.hanging.q[i];
    start.dq[i] = 0;
  }
  bench->Start(start.q, start.dq);
  const double begin = samples.times[window.first];
  std::vector<double> before(motors_);
  std::size_t cursor = 0, state = window.first + 1;
  const auto first = std::ranges::upper_bound(samples.command_times, begin - figures.delay - 1e-3);
  cursor = static_cast<std::size_t>(first - samples.command_times.begin());
  if (cursor > 0) --cursor;
  robot::RobotCommand command;
  for (int step = 0; state < window.first + window.count; ++step) {
    const double t = begin + step * timestep_;
    bench->world().BeginStep();
    // States up to now lie on the line from the step before.
    for (; state < window.first + window.count && samples.times[state] <= t + 1e-9; ++state) {
      const double share = std::clamp((t - samples.times[state]) / timestep_, 0.0, 1.0);
      for (std::size_t i = 0; i < motors_; ++i) {
        const double measured =
            samples.q(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(state));
        const double q = body.q()[i] + share * (before[i] - body.q()[i]);
        *out++ = std::isfinite(measured) && std::isfinite(q) ? q - measured : 0;
      }
    }
    std::ranges::copy(body.q().first(motors_), before.begin());
    command = MeanCommand(samples, t - figures.delay, t - figures.delay + timestep_, &cursor);
    command.motors.resize(body.q().size());
    body.Drive(motors.Step({.command = command, .q = body.q(), .dq = body.dq()}));
    if (bench->world().EndStep() == physics::StepHealth::kFine) continue;
    std::fill_n(out, (window.first + window.count - state) * motors_, kDiverged);
    return;
  }
}

bool Replay::Run(std::span<const Figures> figures, std::span<const ReplayWindow> windows,
                 std::span<double* const> out) const {
  std::vector<std::size_t> places;  // of each window's numbers
  std::size_t place = 0;
  for (const ReplayWindow& window : windows) {
    places.push_back(place);
    place += (window.count - 1) * motors_;
  }
  const auto work = [&](std::size_t thread) {
    for (std::size_t i = 0; i < figures.size(); ++i) {
      benches_[thread]->Use(figures[i].spec, figures[i].mass);
      for (std::size_t j = thread; j < windows.size() && StopSignal() == 0; j += benches_.size()) {
        Simulate(benches_[thread].get(), figures[i], windows[j], out[i] + places[j]);
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < benches_.size(); ++i) others.emplace_back(work, i);
    work(0);
  }
  return StopSignal() == 0;
}

}  // namespace understudy::identify
