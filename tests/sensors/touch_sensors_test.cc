#include "sensors/touch_sensors.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>

namespace understudy::sensors {
namespace {

using testing::ElementsAre;

// Two hands of two cells each.
std::vector<robot::HandSpec> Hands() {
  const std::vector<robot::PadSpec> pads = {{.rows = 1, .columns = 2}};
  return {{.name = "left",
           .pads = pads,
           .touch = {.counts_per_newton = 100, .most_counts = 1000, .noise_counts = 5}},
          {.name = "right", .pads = pads, .touch = {.counts_per_newton = 10}}};
}

std::vector<float> Read(const SensorConfig& config, const std::vector<float>& newtons,
                        std::int64_t tick_ms = 7) {
  std::vector<float> counts(newtons.size(), -1.0F);
  TouchSensors(config, Hands()).Read(newtons, tick_ms, counts);
  return counts;
}

SensorConfig Exact() {
  SensorConfig config;
  config.noise = false;
  return config;
}

TEST(TouchSensorsTest, EachHandHasItsScaleAndItsMost) {
  EXPECT_THAT(Read(Exact(), {1, 11, 1, 11}), ElementsAre(100, 1000, 10, 110));
}

TEST(TouchSensorsTest, CountsAreWholeAndThoseBelowAHalfAreNone) {
  EXPECT_THAT(Read(Exact(), {0.0149F, 0.0049F, 0.06F, 0.04F}), ElementsAre(1, 0, 1, 0));
  SensorConfig fine = Exact();
  fine.quantise = false;
  EXPECT_FLOAT_EQ(Read(fine, {0.0149F, 0, 0, 0})[0], 1.49F);
}

TEST(TouchSensorsTest, WhatFeelsNothingHasNoNoise) {
  SensorConfig config;
  config.noise = true;
  EXPECT_THAT(Read(config, {0, 0, 0, 0}), ElementsAre(0, 0, 0, 0));
}

TEST(TouchSensorsTest, NoiseHasItsDeviationAndDependsOnSeedCellAndTimeAlone) {
  SensorConfig config;
  config.noise = true;
  config.quantise = false;
  double square = 0;
  constexpr int kTimes = 4000;
  for (int t = 0; t < kTimes; ++t) square += std::pow(Read(config, {2, 0, 0, 0}, t)[0] - 200, 2);
  EXPECT_NEAR(std::sqrt(square / kTimes), 5, 0.3);
  EXPECT_EQ(Read(config, {2, 2, 0, 0}), Read(config, {2, 2, 0, 0}));
  EXPECT_EQ(Read(config, {2, 2, 0, 0})[1], Read(config, {0, 2, 1, 1})[1]);
  EXPECT_NE(Read(config, {2, 2, 0, 0})[0], Read(config, {2, 2, 0, 0})[1]);
  SensorConfig other = config;
  other.seed = config.seed + 1;
  EXPECT_NE(Read(config, {2, 0, 0, 0})[0], Read(other, {2, 0, 0, 0})[0]);
}

}  // namespace
}  // namespace understudy::sensors
