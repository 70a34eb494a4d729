// The pads of hands with their errors.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "robot/robot_spec.h"
#include "sensors/sensor_config.h"

namespace understudy::sensors {

// Turns what the cells feel into counts. Cells that feel less than half a count show 0; the others
// have white noise (*assumed*) that depends on seed, cell and time alone, so that it does not
// matter who reads, or when. Allocates only in the constructor.
class TouchSensors {
 public:
  TouchSensors(const SensorConfig& config, const std::vector<robot::HandSpec>& hands);

  // Goes on with other noise.
  void Apply(const SensorConfig& config);
  // Fills `counts` of all cells, in the order of `newtons` (physics::Touch), for that time.
  void Read(std::span<const float> newtons, std::int64_t tick_ms, std::span<float> counts) const;

  std::size_t cells() const { return cells_; }

 private:
  struct Hand {
    robot::TouchSpec spec;
    std::size_t cells = 0;
  };

  std::vector<Hand> hands_;
  std::size_t cells_ = 0;
  int seed_;
  double noise_ = 0;  // in shares of what the hands have
  bool quantise_ = true;
};

}  // namespace understudy::sensors
