#include "sensors/chance.h"

#include <string>

#include "robot/randomization.h"

namespace understudy::sensors {

double Drawn(int seed, std::string_view quantity, std::string_view element, double sigma) {
  robot::Dice dice(seed);
  double sum = 0;  // of three even numbers from -1 to 1: their variance is 1
  for (const char* part : {"/1", "/2", "/3"}) {
    sum += dice.Draw(quantity, std::string(element) + part, -1, 1);
  }
  return sigma * sum;
}

}  // namespace understudy::sensors
