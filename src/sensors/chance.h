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
};

// A stream of independent numbers with mean 0 and standard deviation 1. That the noise of sensors
// is white and bell-shaped is *assumed*. A number is the sum of four even ones, at most 3.5 in
// magnitude, which takes 3 ns instead of the 23 of a normal one.
class Noise {
 public:
  Noise(int seed, std::uint64_t stream)
      : random_(static_cast<std::uint64_t>(seed) + stream * 0x9E3779B97F4A7C15U) {}

  double operator()() {
    constexpr int kPiecesMean = 4 * 65535 / 2;  // of four random integers 0..65535
    // Their deviation: sqrt(4 (65536² - 1) / 12) = 65536 / sqrt(3).
    constexpr double kDeviation = 37837.22;
    const std::uint64_t bits = random_();
    const auto sum = static_cast<int>((bits & 0xFFFF) + (bits >> 16 & 0xFFFF) +
                                      (bits >> 32 & 0xFFFF) + (bits >> 48));
    return (sum - kPiecesMean) / kDeviation;
  }

 private:
  boost::random::mt19937_64 random_;  // the numbers of std::mt19937_64, in a third of its time
};

// Returns a number with mean 0 and standard deviation `sigma`, at most 3 of them in magnitude, that
// depends on seed, quantity and element alone.
double Drawn(int seed, std::string_view quantity, std::string_view element, double sigma);

}  // namespace understudy::sensors
