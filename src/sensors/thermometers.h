// The thermometers of a robot's motors with their errors.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sensors/sensor_config.h"

namespace understudy::sensors {

// A thermometer follows what it is fixed to with a lag of first order, and is off by a constant.
// Allocates only in the constructor.
class Thermometers {
 public:
  // `names` are those of what they are fixed to, for what is drawn; `dt` [s] is the time between
  // steps.
  Thermometers(const SensorConfig& config, const std::vector<std::string>& names, double dt);

  // Goes on with other errors. Allocates nothing.
  void Apply(const SensorConfig& config);
  // Begins anew as if it had been as warm for long; temperatures [°C] in the order of the names,
  // which may be followed by others.
  void Restart(std::span<const double> temperatures_c);
  void Step(std::span<const double> temperatures_c);
  double reading_c(std::size_t i) const { return felt_c_[i] + offsets_c_[i]; }

 private:
  double dt_;
  double share_ = 1;           // of a difference that is followed in a step
  std::vector<double> drawn_;  // offsets with a deviation of 1
  std::vector<double> offsets_c_, felt_c_;
};

}  // namespace understudy::sensors
