// Random numbers of sensors, the same on every machine.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

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
// magnitude, which takes 6 ns instead of the 23 of a normal one.
class Noise {
 public:
  Noise(int seed, std::uint64_t stream)
      : random_(static_cast<std::uint64_t>(seed) + stream * 0x9E3779B97F4A7C15U) {}

  double operator()();

 private:
  std::mt19937_64 random_;
};

// Returns a number with mean 0 and standard deviation `sigma`, at most 3 of them in magnitude, that
// depends on seed, quantity and element alone.
double Drawn(int seed, std::string_view quantity, std::string_view element, double sigma);

}  // namespace understudy::sensors
