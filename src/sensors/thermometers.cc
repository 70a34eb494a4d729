#include "sensors/thermometers.h"

#include <algorithm>
#include <cmath>

#include "sensors/chance.h"

namespace understudy::sensors {

Thermometers::Thermometers(const SensorConfig& config, const std::vector<std::string>& names,
                           double dt)
    : dt_(dt), offsets_c_(names.size()), felt_c_(names.size()) {
  for (const std::string& name : names) {
    drawn_.push_back(Drawn(config.seed, "thermometer.offset_c", name, 1));
  }
  Apply(config);
}

void Thermometers::Apply(const SensorConfig& config) {
  const double inertia = config.thermometer.time_constant;
  share_ = inertia > 0 ? -std::expm1(-dt_ / inertia) : 1;
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    offsets_c_[i] = config.thermometer.offset_c * drawn_[i];
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
