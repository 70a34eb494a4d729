#include "sensors/foot_sensors.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace understudy::sensors {

FootSensors::FootSensors(const SensorConfig& config, const std::vector<robot::FootSpec>& feet,
                         double dt)
    : walked_(feet.size()), dt_(dt), noise_(config.seed, kFeetStream) {
  for (const robot::FootSpec& foot : feet) {
    drawn_offsets_.push_back(Drawn(config.seed, "foot.offset", foot.name, 1));
    for (const robot::FootSpec& other : feet) {
      drawn_gains_.push_back(
          &other == &foot ? Drawn(config.seed, "foot.scale", foot.name, 1)
                          : Drawn(config.seed, "foot.cross_talk", foot.name + "/" + other.name, 1));
    }
  }
  offsets_.resize(drawn_offsets_.size());
  gains_.resize(drawn_gains_.size());
  Apply(config);
}

void FootSensors::Apply(const SensorConfig& config) {
  walk_ = config.foot.walk * std::sqrt(dt_);
  const std::size_t feet = offsets_.size();
  for (std::size_t i = 0; i < feet; ++i) {
    offsets_[i] = config.foot.offset * drawn_offsets_[i];
    for (std::size_t j = 0; j < feet; ++j) {
      const double drawn = drawn_gains_[i * feet + j];
      gains_[i * feet + j] =
          i == j ? 1 + config.foot.scale * drawn : config.foot.cross_talk * drawn;
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
