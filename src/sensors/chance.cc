#include "sensors/chance.h"

#include <string>

#include "robot/randomization.h"

namespace understudy::sensors {

double Noise::operator()() {
  constexpr double kPieceMean = 65535.0 / 2;  // of a random integer 0..65535
  // Deviation of the sum of four of them: sqrt(4 (65536² - 1) / 12) = 65536 / sqrt(3).
  constexpr double kSumDeviation = 37837.22;
  const std::uint64_t bits = random_();
  const std::uint64_t sum =
      (bits & 0xFFFF) + (bits >> 16 & 0xFFFF) + (bits >> 32 & 0xFFFF) + (bits >> 48);
  return (static_cast<double>(sum) - 4 * kPieceMean) / kSumDeviation;
}

double Drawn(int seed, std::string_view quantity, std::string_view element, double sigma) {
  robot::Dice dice(seed);
  double sum = 0;  // of three even numbers from -1 to 1: their variance is 1
  for (const char* part : {"/1", "/2", "/3"}) {
    sum += dice.Draw(quantity, std::string(element) + part, -1, 1);
  }
  return sigma * sum;
}

}  // namespace understudy::sensors
