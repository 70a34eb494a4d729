#include "sensors/touch_sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "robot/hand_law.h"
#include "sensors/chance.h"

namespace understudy::sensors {

TouchSensors::TouchSensors(const SensorConfig& config, const std::vector<robot::HandSpec>& hands)
    : seed_(config.seed) {
  for (const robot::HandSpec& hand : hands) {
    hands_.push_back({hand.touch, robot::CellsOf(hand)});
    cells_ += hands_.back().cells;
  }
  Apply(config);
}

void TouchSensors::Apply(const SensorConfig& config) {
  noise_ = config.noise ? config.noise_gain : 0;
  quantise_ = config.quantise;
}

void TouchSensors::Read(std::span<const float> newtons, std::int64_t tick_ms,
                        std::span<float> counts) const {
  constexpr double kFelt = 0.5;  // counts
  std::size_t cell = 0;
  for (const Hand& hand : hands_) {
    const double most =
        hand.spec.most_counts > 0 ? hand.spec.most_counts : std::numeric_limits<double>::infinity();
    for (const std::size_t end = cell + hand.cells; cell < end; ++cell) {
      double shown = hand.spec.counts_per_newton * static_cast<double>(newtons[cell]);
      if (shown < kFelt) {
        counts[cell] = 0;
        continue;
      }
      if (const double sigma = noise_ * hand.spec.noise_counts; sigma > 0) {
        const std::uint64_t index = static_cast<std::uint64_t>(tick_ms) * cells_ + cell;
        shown += sigma * NoiseAt(seed_, kTouchStream, index);
      }
      shown = std::clamp(shown, 0.0, most);
      counts[cell] = static_cast<float>(quantise_ ? std::round(shown) : shown);
    }
  }
}

}  // namespace understudy::sensors
