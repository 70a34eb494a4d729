// Random numbers of sensors, the same on every machine.
#pragma once

#include <cstdint>
#include <string_view>

#include <boost/random/mersenne_twister.hpp>

namespace understudy::sensors {

// The streams of one seed, apart so that one sensor's errors change no other's. A unit has two.
enum Stream : std::uint64_t {
  kBodyStream = 0,
  kHandsStream = 1,
  kImuStream = 2,
  kSecondaryImuStream = 4,
  kFeetStream = 6,
  kOdometerStream = 7,
  kLidarStream = 8,
  kLidarDirtStream = 9,
  kLidarImuStream = 10,
  kTouchStream = 11,
};

// Returns a number with mean 0 and standard deviation 1, at most 3.5 in magnitude, of 64 random
// bits. That the noise of sensors is white and bell-shaped is *assumed*. It is the sum of four even
// numbers, which takes 3 ns instead of the 23 of a normal one.
inline double NoiseOf(std::uint64_t bits) {
  constexpr int kPiecesMean = 4 * 65535 / 2;  // of four random integers 0..65535
  // Their deviation: sqrt(4 (65536² - 1) / 12) = 65536 / sqrt(3).
  constexpr double kDeviation = 37837.22;
  const auto sum = static_cast<int>((bits & 0xFFFF) + (bits >> 16 & 0xFFFF) +
                                    (bits >> 32 & 0xFFFF) + (bits >> 48));
  return (sum - kPiecesMean) / kDeviation;
}

// A stream of independent numbers, each as NoiseOf.
class Noise {
 public:
  Noise(int seed, std::uint64_t stream)
      : random_(static_cast<std::uint64_t>(seed) + stream * 0x9E3779B97F4A7C15U) {}

  double operator()() { return NoiseOf(random_()); }

 private:
  boost::random::mt19937_64 random_;  // the numbers of std::mt19937_64, in a third of its time
};

// Return number `index` of a stream, which depends on nothing else: as NoiseOf, and one from 0 to 1
// alike.
double NoiseAt(int seed, std::uint64_t stream, std::uint64_t index);
double ShareAt(int seed, std::uint64_t stream, std::uint64_t index);

// Returns a number with mean 0 and standard deviation `sigma`, at most 3 of them in magnitude, that
// depends on seed, quantity and element alone.
double Drawn(int seed, std::string_view quantity, std::string_view element, double sigma);

}  // namespace understudy::sensors
