#include "sensors/chance.h"

#include <string>

#include "robot/randomization.h"

namespace understudy::sensors {
namespace {

// The output function of SplitMix64.
std::uint64_t Mixed(std::uint64_t bits) {
  bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9U;
  bits = (bits ^ bits >> 27) * 0x94D049BB133111EBU;
  return bits ^ bits >> 31;
}

std::uint64_t BitsAt(int seed, std::uint64_t stream, std::uint64_t index) {
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;
  const std::uint64_t start = Mixed(static_cast<std::uint64_t>(seed) + stream * kGolden);
  return Mixed(start + index * kGolden);
}

}  // namespace

double NoiseAt(int seed, std::uint64_t stream, std::uint64_t index) {
  return NoiseOf(BitsAt(seed, stream, index));
}

double ShareAt(int seed, std::uint64_t stream, std::uint64_t index) {
  return static_cast<double>(BitsAt(seed, stream, index) >> 11) * 0x1p-53;
}

double Drawn(int seed, std::string_view quantity, std::string_view element, double sigma) {
  robot::Randomizer randomizer(seed);
  double sum = 0;  // of three even numbers from -1 to 1: their variance is 1
  for (const char* part : {"/1", "/2", "/3"}) {
    sum += randomizer.Draw(quantity, std::string(element) + part, -1, 1);
  }
  return sigma * sum;
}

}  // namespace understudy::sensors
