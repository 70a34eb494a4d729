#include "sensors/thermometers.h"

#include <cmath>

#include <gtest/gtest.h>

namespace understudy::sensors {
namespace {

TEST(ThermometersTest, TellTheTruthWithoutErrors) {
  Thermometers thermometers({}, {"a", "b"}, 0.001);
  thermometers.Restart(std::vector<double>{20, 30});
  EXPECT_EQ(thermometers.reading_c(1), 30);
  thermometers.Step(std::vector<double>{40, 50});
  EXPECT_EQ(thermometers.reading_c(0), 40);
  EXPECT_EQ(thermometers.reading_c(1), 50);
}

TEST(ThermometersTest, FollowWithTheirTimeConstant) {
  Thermometers thermometers({.thermometer = {.time_constant = 2}}, {"a"}, 0.001);
  thermometers.Restart(std::vector<double>{20});
  EXPECT_EQ(thermometers.reading_c(0), 20);
  for (int i = 0; i < 2000; ++i) thermometers.Step(std::vector<double>{70});
  EXPECT_NEAR(thermometers.reading_c(0), 70 - 50 * std::exp(-1), 1e-9);
}

TEST(ThermometersTest, AreOffEachByItsOwn) {
  Thermometers thermometers({.seed = 3, .thermometer = {.offset_c = 2}}, {"a", "b"}, 0.001);
  thermometers.Restart(std::vector<double>{20, 20});
  EXPECT_NE(thermometers.reading_c(0), 20);
  EXPECT_NE(thermometers.reading_c(0), thermometers.reading_c(1));
  EXPECT_LE(std::abs(thermometers.reading_c(0) - 20), 6);
}

TEST(ThermometersTest, AreOtherOnesForAnotherSeed) {
  Thermometers one({.seed = 3, .thermometer = {.offset_c = 2}}, {"a"}, 0.001);
  Thermometers other({.seed = 4, .thermometer = {.offset_c = 2}}, {"a"}, 0.001);
  EXPECT_NE(one.reading_c(0), other.reading_c(0));
}

}  // namespace
}  // namespace understudy::sensors
