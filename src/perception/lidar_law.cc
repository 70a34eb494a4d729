#include "perception/lidar_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace understudy::perception {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

// Of a half circle of kSamples samples, `turns` of them about z in 100 s.
template <std::int64_t kSamples, std::int64_t kSlotsPerSecond, std::int64_t kTurns>
Vector3d LookInHalfCircles(std::int64_t slot) {
  static const auto kElevations = [] {
    std::array<std::array<double, 2>, kSamples> elevations;
    for (std::size_t i = 0; i < elevations.size(); ++i) {
      const double angle = pi * static_cast<double>(i) / kSamples;
      elevations[i] = {std::cos(angle), std::sin(angle)};
    }
    return elevations;
  }();
  const std::int64_t sample = slot % (2 * kSamples);
  if (sample >= kSamples) return Vector3d::Zero();
  constexpr std::int64_t kRound = 100 * kSlotsPerSecond;
  const double azimuth = 2 * pi * static_cast<double>(slot * kTurns % kRound) / kRound;
  const auto& [across, up] = kElevations[static_cast<std::size_t>(sample)];
  return {-std::sin(azimuth) * across, std::cos(azimuth) * across, up};
}

// *Assumed*, all but the limits: both periods are prime, so that no cloud is as one before.
constexpr std::int64_t kBeams = 4;
constexpr std::int64_t kTurn = 997;  // firings a turn: 50.15 turns a second
constexpr std::int64_t kNod = 6803;  // firings from the lowest to the highest and back: 7.35 Hz
constexpr double kLowest = -7 * pi / 180, kHighest = 52 * pi / 180;
constexpr std::size_t kLevels = 1024;

Vector3d LookAsMid360(std::int64_t slot) {
  struct Tables {
    std::array<std::array<double, 2>, kTurn> azimuths;
    std::array<std::array<double, 2>, kLevels> elevations;
  };
  static const Tables kTables = [] {
    Tables tables;
    for (std::size_t i = 0; i < tables.azimuths.size(); ++i) {
      const double angle = 2 * pi * static_cast<double>(i) / kTurn;
      tables.azimuths[i] = {std::cos(angle), std::sin(angle)};
    }
    for (std::size_t i = 0; i < kLevels; ++i) {
      const double angle = kLowest + (kHighest - kLowest) * static_cast<double>(i) / (kLevels - 1);
      tables.elevations[i] = {std::cos(angle), std::sin(angle)};
    }
    return tables;
  }();
  const std::int64_t firing = slot / kBeams, beam = slot % kBeams;
  const auto& [x, y] = kTables.azimuths[static_cast<std::size_t>(firing % kTurn)];
  // The beams are a quarter of a nod apart.
  const std::int64_t at = (firing + beam * kNod / kBeams) % kNod;
  const std::int64_t way = std::min(at, kNod - at);
  const auto level = static_cast<std::size_t>(way) * (kLevels - 1) / (kNod / 2);
  const auto& [across, up] = kTables.elevations[level];
  return {x * across, y * across, up};
}

// L1: 180 half circles a second of 120 samples, twelve of them a cloud; 11 turns a second, not in
//   step with them: derived from the times of real clouds, the hundredth of a turn is *assumed*.
// L2: 216 of 300, fourteen a cloud: derived from the number of points and the time of the last of
//   real clouds; its turns are *assumed*.
// Mid-360: 20000 points in 0.1 s of real clouds.
constexpr auto kLaws = std::to_array<LidarLaw>({
    {"L1", 43'200, 12L * 240, 12L * 120, 0.0445, false, 250, &LookInHalfCircles<120, 43'200, 1101>},
    {"L2", 129'600, 14L * 600, 14L * 300, 0.0445, false, 250,
     &LookInHalfCircles<300, 129'600, 555>},
    {"Mid-360", 200'000, 20'000, 20'000, 0, true, 200, &LookAsMid360},
});

}  // namespace

std::span<const LidarLaw> LidarLaws() { return kLaws; }

const LidarLaw& LawOf(std::string_view make) {
  return *std::ranges::find(kLaws, make, &LidarLaw::make);
}

}  // namespace understudy::perception
