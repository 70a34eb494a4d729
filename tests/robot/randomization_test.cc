#include "robot/randomization.h"

#include <cstdint>
#include <random>
#include <set>
#include <string_view>

#include <gmock/gmock.h>

namespace understudy::robot {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Worked out apart: FNV-1a of quantity, 0, element, plus the seed, seeds a 64-bit Mersenne Twister;
// the upper 53 bits of what it gives first are the fraction of the range.
TEST(DiceTest, ThrowTheSameForTheSameSeedOnEveryMachine) {
  Randomizer randomizer(7);
  EXPECT_EQ(randomizer.Draw("mass", "base_link", 0.9, 1.1), 1.071158404854135);
  EXPECT_EQ(randomizer.Draw("mass", "FL_hip", 0.9, 1.1), 0.9088873172354565);
  EXPECT_EQ(randomizer.Draw("friction", "", 0, 1), 0.6367333097963079);
  EXPECT_EQ(Randomizer(8).Draw("mass", "base_link", 0.9, 1.1), 1.099605042037077);
}

// Spelled out by the standard's own engine.
TEST(DiceTest, ThrowWhatAMersenneTwisterGivesFirst) {
  const auto fnv = [](std::string_view bytes) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return hash;
  };
  for (int seed = 0; seed < 1000; ++seed) {
    using std::string_view_literals::operator""sv;
    std::mt19937_64 engine(fnv("mass\0trunk"sv) + static_cast<std::uint64_t>(seed));
    const double first = static_cast<double>(engine() >> 11) * 0x1p-53;
    ASSERT_EQ(Randomizer(seed).Draw("mass", "trunk", 0, 1), first);
  }
}

TEST(DiceTest, ThrowOtherwiseForEachSeedQuantityAndElement) {
  std::set<double> values;
  for (const int seed : {0, 1, 2, 2147483647}) {
    for (const char* quantity : {"mass", "inertia"}) {
      for (const char* element : {"", "a", "b"}) {
        values.insert(Randomizer(seed).Draw(quantity, element, 0, 1));
      }
    }
  }
  EXPECT_EQ(values.size(), 4U * 2 * 3);
}

// "ab" + "c" is not "a" + "bc".
TEST(DiceTest, TellAQuantityFromItsElement) {
  EXPECT_NE(Randomizer(1).Draw("ab", "c", 0, 1), Randomizer(1).Draw("a", "bc", 0, 1));
}

TEST(DiceTest, DoNotMindWhatElseIsDrawn) {
  Randomizer alone(3), together(3);
  together.Draw("friction", "", 0, 1);
  together.Draw("mass", "a", 0, 1);
  EXPECT_EQ(alone.Draw("mass", "b", 0, 1), together.Draw("mass", "b", 0, 1));
}

TEST(DiceTest, CoverTheirRangeEvenlyAndNeverLeaveIt) {
  constexpr int kCells = 10, kSeeds = 10000;
  std::vector<int> cells(kCells);
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double value = Randomizer(seed).Draw("mass", "base_link", -2, 3);
    ASSERT_GE(value, -2);
    ASSERT_LT(value, 3);
    ++cells[static_cast<std::size_t>((value + 2) / 5 * kCells)];
  }
  // Binomial: 1000 +- 30; five deviations.
  for (const int count : cells) EXPECT_NEAR(count, kSeeds / kCells, 150);
}

TEST(DiceTest, GiveTheValueItselfWhereLeastIsMost) {
  EXPECT_EQ(Randomizer(1).Draw("delay", "", 0.003, 0.003), 0.003);
}

TEST(DiceTest, DrawNothingFromAnEmptyRange) {
  Randomizer randomizer(1);
  EXPECT_EQ(randomizer.DrawOr("mass", "a", {}, 42), 42);
  EXPECT_THAT(randomizer.draws().values, IsEmpty());
}

TEST(DiceTest, NoteWhatTheyThrow) {
  Randomizer randomizer(5);
  const double friction = randomizer.Draw("friction", "", 0.5, 1.5);
  const double mass = randomizer.Draw("mass", "trunk", 0.5, 1.5);
  EXPECT_EQ(randomizer.draws().seed, 5);
  EXPECT_THAT(randomizer.draws().values,
              ElementsAre(Drawn{"friction", "", friction}, Drawn{"mass", "trunk", mass}));
}

TEST(TimestepsTest, AreThoseThatDivideThePeriodsIntoWholeNanoseconds) {
  const RateSpec rates{.lowstate_hz = 500, .service_hz = 500};
  EXPECT_THAT(PossibleTimesteps({0.0004, 0.002}, rates),
              ElementsAre(0.002, 0.001, 0.0005, 0.0004));  // a third of 2 ms is not whole
  EXPECT_THAT(PossibleTimesteps({0.0006, 0.0009}, rates), IsEmpty());
  EXPECT_THAT(PossibleTimesteps({0.0005, 0.002}, {.lowstate_hz = 1000, .service_hz = 500}),
              ElementsAre(0.001, 0.0005));
  EXPECT_THAT(PossibleTimesteps({0.0005, 0.002}, {.lowstate_hz = 500, .service_hz = 1000}),
              ElementsAre(0.001, 0.0005));
}

TEST(TimestepsTest, AreEachDrawnAsOften) {
  const std::vector<double> steps = PossibleTimesteps({0.0005, 0.002}, {});
  ASSERT_EQ(steps.size(), 3U);
  std::map<double, int> counts;
  for (int seed = 0; seed < 3000; ++seed) ++counts[Randomizer(seed).DrawOneOf("timestep", steps)];
  for (const double step : steps) EXPECT_NEAR(counts[step], 1000, 130) << step;
}

class MotorsTest : public testing::Test {
 protected:
  MotorsTest() {
    robot_.motors = {{.joint = "hip"}, {.joint = "knee", .strength = 0.5, .kp_scale = 2}};
    robot_.hands = {{.motors = {{.joint = "thumb"}}}};
    robot_.dynamics.delay = 0.001;
  }

  RobotSpec Randomized(const RandomizationSpec& ranges, int seed = 1) {
    RobotSpec robot = robot_;
    Randomizer randomizer(seed);
    RandomizeMotors(ranges, "", &randomizer, &robot);
    return robot;
  }

  RobotSpec robot_;
};

TEST_F(MotorsTest, AreAsTheyWereWhereNothingIsToBeDrawn) {
  const RobotSpec robot = Randomized({});
  EXPECT_EQ(robot.motors[0].strength, 1);
  EXPECT_EQ(robot.motors[1].strength, 0.5);
  EXPECT_EQ(robot.motors[1].kp_scale, 2);
  EXPECT_EQ(robot.dynamics.delay, 0.001);
}

TEST_F(MotorsTest, HaveEachAStrengthOfItsOwnTimesTheirs) {
  const RobotSpec robot = Randomized({.motor_strength = {0.8, 1.2}});
  EXPECT_GE(robot.motors[0].strength, 0.8);
  EXPECT_LE(robot.motors[0].strength, 1.2);
  EXPECT_GE(robot.motors[1].strength, 0.4);
  EXPECT_LE(robot.motors[1].strength, 0.6);
  EXPECT_NE(robot.motors[0].strength, 2 * robot.motors[1].strength);
  EXPECT_NEAR(robot.hands[0].motors[0].strength, 1, 0.2);
  EXPECT_NE(robot.hands[0].motors[0].strength, 1);
  EXPECT_EQ(robot.motors[0].kp_scale, 1);
}

TEST_F(MotorsTest, HaveEachGainsOfItsOwn) {
  const RobotSpec robot = Randomized({.kp = {0.8, 0.9}, .kd = {1.1, 1.2}});
  EXPECT_GE(robot.motors[0].kp_scale, 0.8);
  EXPECT_LE(robot.motors[0].kp_scale, 0.9);
  EXPECT_GE(robot.motors[0].kd_scale, 1.1);
  EXPECT_LE(robot.motors[0].kd_scale, 1.2);
  EXPECT_NE(robot.motors[1].kd_scale, robot.motors[0].kd_scale);
  EXPECT_EQ(robot.motors[0].strength, 1);
}

TEST_F(MotorsTest, FollowLaterByTheDelayDrawn) {
  EXPECT_EQ(Randomized({.delay = {0.003, 0.003}}).dynamics.delay, 0.004);
  const double one = Randomized({.delay = {0, 0.01}}, 1).dynamics.delay;
  EXPECT_EQ(one, Randomized({.delay = {0, 0.01}}, 1).dynamics.delay);
  EXPECT_NE(one, Randomized({.delay = {0, 0.01}}, 2).dynamics.delay);
}

}  // namespace
}  // namespace understudy::robot
