#include "sensors/foot_sensors.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace understudy::sensors {
namespace {

const std::vector<robot::FootSpec> kFeet = {
    {.name = "FR", .geoms = {}}, {.name = "FL", .geoms = {}}, {.name = "RR", .geoms = {}}};
const std::vector<double> kNone = {0, 0, 0};

// The deviation of f(seed, foot) over many seeds and the feet.
template <class F>
double Deviation(F of) {
  constexpr int kSeeds = 400;
  double square = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    for (std::size_t foot = 0; foot < kFeet.size(); ++foot) square += std::pow(of(seed, foot), 2);
  }
  return std::sqrt(square / (kSeeds * static_cast<double>(kFeet.size())));
}

TEST(FootSensorsTest, TellTheTruthWithoutErrors) {
  FootSensors feet({}, kFeet, 0.001);
  feet.Step();
  const std::vector<double> forces = {10, 20, 30};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(feet.Read(i, forces), forces[i]);
}

TEST(FootSensorsTest, ReadAnOffsetOfTheirOwn) {
  const double sigma = Deviation([](int seed, std::size_t foot) {
    return FootSensors({.seed = seed, .foot = {.offset = 4}}, kFeet, 0.001).Read(foot, kNone);
  });
  EXPECT_NEAR(sigma, 4, 0.3);
}

TEST(FootSensorsTest, ReadTheirForceTimesAGainAndAShareOfEachOther) {
  const SensorConfig config{.foot = {.scale = 0.1, .cross_talk = 0.05}};
  const FootSensors feet(config, kFeet, 0.001);
  double matrix[3][3];
  for (std::size_t other = 0; other < 3; ++other) {
    std::vector<double> one = kNone;
    one[other] = 1;
    for (std::size_t foot = 0; foot < 3; ++foot) matrix[foot][other] = feet.Read(foot, one);
  }
  EXPECT_NE(matrix[0][1], matrix[1][0]);
  EXPECT_NE(matrix[0][1], 0);
  const std::vector<double> forces = {100, 50, -20};
  for (std::size_t foot = 0; foot < 3; ++foot) {
    EXPECT_NEAR(feet.Read(foot, forces),
                matrix[foot][0] * 100 + matrix[foot][1] * 50 - matrix[foot][2] * 20, 1e-12);
  }
  const auto read = [](int seed, std::size_t foot, std::size_t of) {
    std::vector<double> one = kNone;
    one[of] = 1;
    const SensorConfig drawn{.seed = seed, .foot = {.scale = 0.1, .cross_talk = 0.05}};
    return FootSensors(drawn, kFeet, 0.001).Read(foot, one);
  };
  EXPECT_NEAR(Deviation([&](int s, std::size_t foot) { return read(s, foot, foot) - 1; }), 0.1,
              0.008);
  EXPECT_NEAR(Deviation([&](int s, std::size_t foot) { return read(s, foot, (foot + 1) % 3); }),
              0.05, 0.004);
}

TEST(FootSensorsTest, WalkAwayWithTheRootOfTimeAndComeBackAtARestart) {
  const auto after = [](int steps, bool restarts) {
    return Deviation([=](int seed, std::size_t foot) {
      FootSensors feet({.seed = seed, .foot = {.walk = 2}}, kFeet, 0.01);
      for (int i = 0; i < steps; ++i) feet.Step();
      if (restarts) feet.Restart();
      return feet.Read(foot, kNone);
    });
  };
  EXPECT_NEAR(after(25, false), 1, 0.08);   // a quarter of a second
  EXPECT_NEAR(after(400, false), 4, 0.32);  // four seconds
  EXPECT_EQ(after(400, true), 0);
}

TEST(FootSensorsTest, ErrEachByItsOwn) {
  FootSensors feet({.foot = {.offset = 4}}, kFeet, 0.001);
  EXPECT_NE(feet.Read(0, kNone), feet.Read(1, kNone));
  EXPECT_NE(feet.Read(1, kNone), feet.Read(2, kNone));
  FootSensors walking({.foot = {.walk = 4}}, kFeet, 0.001);
  walking.Step();
  EXPECT_NE(walking.Read(0, kNone), walking.Read(1, kNone));
  EXPECT_NE(walking.Read(1, kNone), walking.Read(2, kNone));
}

TEST(FootSensorsTest, GoOnWithOtherErrorsAsIfTheyHadHadThemFromTheStart) {
  const SensorConfig config{.foot = {.offset = 4, .scale = 0.1, .cross_talk = 0.05}};
  const FootSensors wanted(config, kFeet, 0.001);
  FootSensors feet({}, kFeet, 0.001);
  feet.Apply(config);
  const std::vector<double> forces = {100, 50, 20};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(feet.Read(i, forces), wanted.Read(i, forces));
}

}  // namespace
}  // namespace understudy::sensors
