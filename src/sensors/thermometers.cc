#include "sensors/thermometers.h"

#include <algorithm>
#include <cmath>

namespace understudy::sensors {

Thermometers::Thermometers(const SensorConfig& config, const std::vector<std::string>& names,
                           double dt)
    : share_(config.thermometer.time_constant > 0
                 ? -std::expm1(-dt / config.thermometer.time_constant)
                 : 1),
      felt_c_(names.size()) {
  for (const std::string& name : names) {
    offsets_c_.push_back(
        Drawn(config.seed, "thermometer.offset_c", name, config.thermometer.offset_c));
  }
}

void Thermometers::Restart(std::span<const double> temperatures_c) {
  std::ranges::copy(temperatures_c.first(felt_c_.size()), felt_c_.begin());
}

void Thermometers::Step(std::span<const double> temperatures_c) {
  if (share_ == 1) return Restart(temperatures_c);
  for (std::size_t i = 0; i < felt_c_.size(); ++i) {
    felt_c_[i] += share_ * (temperatures_c[i] - felt_c_[i]);
  }
}

}  // namespace understudy::sensors
