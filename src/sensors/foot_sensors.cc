#include "sensors/foot_sensors.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace understudy::sensors {

FootSensors::FootSensors(const SensorConfig& config, const std::vector<robot::FootSpec>& feet,
                         double dt)
    : walked_(feet.size()),
      walk_(config.foot.walk * std::sqrt(dt)),
      noise_(config.seed, kFeetStream) {
  for (const robot::FootSpec& foot : feet) {
    offsets_.push_back(Drawn(config.seed, "foot.offset", foot.name, config.foot.offset));
    for (const robot::FootSpec& other : feet) {
      gains_.push_back(&other == &foot
                           ? 1 + Drawn(config.seed, "foot.scale", foot.name, config.foot.scale)
                           : Drawn(config.seed, "foot.cross_talk", foot.name + "/" + other.name,
                                   config.foot.cross_talk));
    }
  }
}

void FootSensors::Restart() { std::ranges::fill(walked_, 0); }

void FootSensors::Step() {
  if (walk_ <= 0) return;
  for (double& one : walked_) one += walk_ * noise_();
}

double FootSensors::Read(std::size_t foot, std::span<const double> forces) const {
  double reading = offsets_[foot] + walked_[foot];
  for (std::size_t i = 0; i < forces.size(); ++i) {
    reading += gains_[foot * forces.size() + i] * forces[i];
  }
  return reading;
}

}  // namespace understudy::sensors
