#include "robot/randomization.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace understudy::robot {
namespace {

// The 64-bit FNV-1a hash of a name.
std::uint64_t HashOf(std::string_view quantity, std::string_view element) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add = [&hash](unsigned char byte) { hash = (hash ^ byte) * 0x100000001b3U; };
  for (const char c : quantity) add(static_cast<unsigned char>(c));
  add(0);
  for (const char c : element) add(static_cast<unsigned char>(c));
  return hash;
}

// The first number of std::mt19937_64(seed), without the 311 others that it makes ready. Constants
// and formulas: M. Matsumoto, T. Nishimura, mt19937-64 (2004), as the C++ standard has them.
std::uint64_t FirstOfMersenneTwister(std::uint64_t seed) {
  constexpr std::size_t kMiddle = 156;
  std::array<std::uint64_t, kMiddle + 1> state{seed};
  for (std::size_t i = 1; i < state.size(); ++i) {
    state[i] = 0x5851f42d4c957f2dU * (state[i - 1] ^ (state[i - 1] >> 62)) + i;
  }
  constexpr std::uint64_t kLower = (std::uint64_t{1} << 31) - 1;
  const std::uint64_t joined = (state[0] & ~kLower) | (state[1] & kLower);
  std::uint64_t x = state[kMiddle] ^ (joined >> 1) ^ ((joined & 1) * 0xb5026f5aa96619e9U);
  x ^= (x >> 29) & 0x5555555555555555U;
  x ^= (x << 17) & 0x71d67fffeda60000U;
  x ^= (x << 37) & 0xfff7eee000000000U;
  return x ^ (x >> 43);
}

// The period [ns] of a rate, 0 if it is not whole.
std::int64_t WholePeriod(double hz) {
  const double period = std::round(1e9 / hz);
  return std::abs(period * hz - 1e9) < 1e-3 ? static_cast<std::int64_t>(period) : 0;
}

}  // namespace

double Randomizer::Draw(std::string_view quantity, std::string_view element, double low,
                        double high) {
  // fma, because some compilers contract a product and a sum and others do not.
  const double value = std::fma(high - low, Throw(quantity, element), low);
  return Note(quantity, element, std::min(value, high));
}

double Randomizer::DrawOr(std::string_view quantity, std::string_view element,
                          const RandomizationSpec::Limits& limits, double otherwise) {
  return limits.empty() ? otherwise : Draw(quantity, element, limits[0], limits[1]);
}

double Randomizer::DrawOneOf(std::string_view quantity, const std::vector<double>& values) {
  const double place = Throw(quantity, "") * static_cast<double>(values.size());
  return Note(quantity, "", values[static_cast<std::size_t>(place)]);
}

double Randomizer::Throw(std::string_view quantity, std::string_view element) const {
  const std::uint64_t seed = HashOf(quantity, element) + static_cast<std::uint64_t>(draws_.seed);
  // 53 bits; the standard's distributions differ between libraries.
  return static_cast<double>(FirstOfMersenneTwister(seed) >> 11) * 0x1p-53;
}

double Randomizer::Note(std::string_view quantity, std::string_view element, double value) {
  draws_.values.push_back({std::string(quantity), std::string(element), value});
  return value;
}

std::vector<double> PossibleTimesteps(const RandomizationSpec::Limits& limits,
                                      const RateSpec& rates) {
  std::vector<double> steps;
  const std::int64_t least = std::max(std::llround(limits[0] * 1e9), 1LL);
  const std::int64_t most = std::llround(limits[1] * 1e9);
  const std::int64_t period = WholePeriod(rates.lowstate_hz);
  const std::int64_t service = WholePeriod(rates.service_hz);
  for (std::int64_t parts = 1; parts * least <= period; ++parts) {
    const std::int64_t step = period / parts;
    if (period % parts != 0 || step > most || service == 0 || service % step != 0) continue;
    steps.push_back(static_cast<double>(step) / 1e9);
  }
  return steps;
}

void RandomizeMotors(const RandomizationSpec& ranges, const std::string& prefix,
                     Randomizer* randomizer, RobotSpec* robot) {
  for (MotorSpec* motor : AllMotors(*robot)) {
    const std::string joint = prefix + motor->joint;
    motor->strength *= randomizer->DrawOr("motor_strength", joint, ranges.motor_strength, 1);
    motor->kp_scale *= randomizer->DrawOr("kp", joint, ranges.kp, 1);
    motor->kd_scale *= randomizer->DrawOr("kd", joint, ranges.kd, 1);
  }
  robot->dynamics.delay += randomizer->DrawOr("delay", prefix, ranges.delay, 0);
}

}  // namespace understudy::robot
