// Tests valid and invalid values of the section randomization.
#include "config/randomization_keys.h"
#include "config_fixture.h"

namespace understudy::config {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class RandomizationTest : public ConfigFixture {};

TEST_F(RandomizationTest, DrawsNothingUnlessToldTo) {
  EXPECT_FALSE(IsRandom(Load({}).randomization));
  EXPECT_EQ(Load({}).randomization.seed, -1);
  EXPECT_FALSE(IsRandom(Load({}, {"randomization.seed=3"}).randomization));
}

TEST_F(RandomizationTest, EveryRangeIsReadAndMakesTheRunRandom) {
  for (const RandomRange& range : RandomRanges()) {
    const std::string limits = range.name == "timestep" ? "[0.0005, 0.001]" : "[0.01, 0.02]";
    const std::string set = "randomization." + std::string(range.name) + "=" + limits;
    const robot::RandomizationSpec spec = Load({}, {set}).randomization;
    EXPECT_TRUE(IsRandom(spec)) << set;
    EXPECT_EQ((spec.*range.limits).size(), 2U) << set;
  }
}

TEST_F(RandomizationTest, AnEmptyRangeTakesOneBack) {
  const std::string file = Write("run.yaml", "randomization: {mass: [0.9, 1.1]}\n");
  EXPECT_THAT(Load({file}).randomization.mass, ElementsAre(0.9, 1.1));
  EXPECT_FALSE(IsRandom(Load({file}, {"randomization.mass=[]"}).randomization));
}

TEST_F(RandomizationTest, RefusesAQuantityThatIsNone) {
  EXPECT_THAT(FileError("randomization: {masses: [1, 2]}\n"),
              HasSubstr("run.yaml:1: key 'randomization.masses': unknown; did you mean 'mass'?"));
}

TEST_F(RandomizationTest, RefusesLeastAfterMost) {
  EXPECT_EQ(FileError("randomization:\n  mass: [1.1, 0.9]\n"),
            "run.yaml:2: randomization.mass: expected least before most, got 1.1 before 0.9");
}

TEST_F(RandomizationTest, RefusesARangeThatIsNotTwoNumbers) {
  EXPECT_THAT(
      SetError("randomization.mass=[1]"),
      HasSubstr("randomization.mass: expected [least, most], or [] to draw nothing, got 1"));
  EXPECT_THAT(SetError("randomization.mass=[1, 2, 3]"), HasSubstr("got 3 numbers"));
  EXPECT_THAT(SetError("randomization.mass=1.2"), HasSubstr("expected a list of numbers"));
  EXPECT_THAT(SetError("randomization.mass=[1, heavy]"), HasSubstr("randomization.mass.1"));
}

TEST_F(RandomizationTest, RefusesWhatIsNotPhysical) {
  for (const char* set : {"mass=[0, 1]",
                          "mass=[-1, 1]",
                          "inertia=[0, 1]",
                          "friction=[0, 1]",
                          "floor_softness=[0, 1]",
                          "motor_strength=[-0.1, 1]",
                          "damping=[-1, 1]",
                          "armature=[-1, 1]",
                          "frictionloss=[-1, 1]",
                          "kp=[-1, 1]",
                          "kd=[-1, 1]",
                          "delay=[-0.001, 0]",
                          "delay=[0, 1]",
                          "gravity_tilt=[-0.1, 0]",
                          "gravity_tilt=[0, 3]",
                          "base_com=[-2, 0]",
                          "imu_mounting=[0, 4]",
                          "timestep=[0, 0.001]",
                          "mass=[1, .inf]",
                          "mass=[.nan, 1]"}) {
    const std::string key = "randomization." + std::string(set);
    EXPECT_THAT(SetError(key), HasSubstr("expected a number")) << set;
  }
}

TEST_F(RandomizationTest, RefusesTimestepsNoneOfWhichTheRatesAllow) {
  EXPECT_THAT(
      SetError("randomization.timestep=[0.0006, 0.0009]"),
      HasSubstr("randomization.timestep: no step in it divides the periods of 500 and 500"));
}

TEST_F(RandomizationTest, RefusesASeedThatIsNone) {
  EXPECT_THAT(SetError("randomization.seed=-2"), HasSubstr("whole number from -1 to 2147483647"));
  EXPECT_THAT(SetError("randomization.seed=1.5"), HasSubstr("expected a whole number"));
  EXPECT_THAT(SetError("randomization.seed=2147483648"), HasSubstr("expected a whole number"));
}

}  // namespace
}  // namespace understudy::config
