// The force sensors of a robot's feet with their errors.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "robot/robot_spec.h"
#include "sensors/chance.h"
#include "sensors/sensor_config.h"

namespace understudy::sensors {

// A foot reads its own force times a gain, a share of what the others carry, and an offset that
// walks. What is drawn depends on the feet's names. Allocates only in the constructor.
class FootSensors {
 public:
  // `dt` [s] is the time between steps.
  FootSensors(const SensorConfig& config, const std::vector<robot::FootSpec>& feet, double dt);

  // Goes on with other errors: what was drawn is scaled, walks stay. Allocates nothing.
  void Apply(const SensorConfig& config);
  // Takes the walks back.
  void Restart();
  // Advances the walks by dt.
  void Step();
  // Returns what a foot reads [N] while `forces` press on all, in their order. Below 0 where its
  // offset is.
  double Read(std::size_t foot, std::span<const double> forces) const;

 private:
  // As drawn with deviations of 1, and what comes of it.
  std::vector<double> drawn_gains_, gains_;  // by foot that reads and foot that carries
  std::vector<double> drawn_offsets_, offsets_;
  std::vector<double> walked_;
  double dt_;
  double walk_ = 0;  // N, standard deviation of a step
  Noise noise_;
};

}  // namespace understudy::sensors
