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

  // Takes the walks back.
  void Restart();
  // Advances the walks by dt.
  void Step();
  // Returns what a foot reads [N] while `forces` press on all, in their order. Below 0 where its
  // offset is.
  double Read(std::size_t foot, std::span<const double> forces) const;

 private:
  std::vector<double> gains_;  // by foot that reads and foot that carries
  std::vector<double> offsets_, walked_;
  double walk_;  // N, standard deviation of a step
  Noise noise_;
};

}  // namespace understudy::sensors
