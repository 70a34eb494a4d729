// Finds what was drawn, and refuses what the data cannot tell. UNDERSTUDY_IDENTIFY_SEEDS is how
// many seeds are drawn, 1 unless it says otherwise; docs/reference/identify.md has the result
// of 20.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/load.h"
#include "identify/identify.h"
#include "schema/yaml_document.h"
#include "tests/identify/randomized_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::identify {
namespace {

using testing::HasSubstr;

int Seeds() {
  const char* const given = std::getenv("UNDERSTUDY_IDENTIFY_SEEDS");
  return given == nullptr ? 1 : std::stoi(given);
}

const Found& Of(const Identification& result, const std::string& name) {
  for (const Found& found : result.found) {
    if (found.name == name) return found;
  }
  throw std::out_of_range(name);
}

// Tells at the end how many figures of all robots were within which error bars.
class RecoveryTest : public test::MujocoTest, public testing::WithParamInterface<int> {
 protected:
  static void TearDownTestSuite() {
    std::printf("of %d figures within bars of", figures_);
    for (const auto& [probability, within] : within_) {
      std::printf("%s %g %%: %d", probability == 0.5 ? "" : ",", 100 * probability, within);
    }
    std::printf("; within three standard errors: %d\n", within_three_);
  }
  static void Count(const Found& found, double error) {
    ++figures_;
    for (auto& [probability, within] : within_) within += error <= found.Bar(probability) ? 1 : 0;
    within_three_ += error <= 3 * found.error ? 1 : 0;
  }

 private:
  static inline int figures_ = 0, within_three_ = 0;
  static inline std::map<double, int> within_{{0.5, 0}, {0.8, 0}, {0.95, 0}, {0.9999, 0}};
};

TEST_P(RecoveryTest, FindsWhatWasDrawnWithinItsErrorBars) {
  const Drawn drawn = Draw("go2", GetParam(), kShortExcitation);
  const Identification result = IdentifiedBy(drawn, {}, true);
  ASSERT_EQ(result.found.size(), 37u);
  int outside = 0;
  for (const Found& found : result.found) {
    ASSERT_TRUE(found.told) << found.name << ": " << found.why;
    const double error = std::abs(found.value - drawn.truth.at(found.name));
    Count(found, error);
    outside += error > found.Bar(0.95) ? 1 : 0;
    // Chance puts one figure of 10 000 outside this.
    EXPECT_LT(error, found.Bar(0.9999)) << found.name << ", standard error " << found.error;
  }
  // Chance puts two of 37 outside their bars; those of a limb hang together, so at times many are.
  EXPECT_LE(outside, 9);
  EXPECT_LT(result.held_out.after, 0.2 * result.held_out.before);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RecoveryTest, testing::Range(1, 1 + Seeds()));

class DrawnTest : public test::MujocoTest {};

TEST_F(DrawnTest, FindsADrawnDelayAndArmatureWithinThreeStandardErrors) {
  const Drawn drawn = Draw("go2", 1, kShortExcitation);
  const Identification result =
      IdentifiedBy(drawn, {.parameters = {"armature", "damping", "frictionloss", "delay"}}, true);
  for (const char* name :
       {"armature FR_calf", "damping RL_hip", "frictionloss FL_thigh", "delay"}) {
    const Found& found = Of(result, name);
    EXPECT_TRUE(found.told) << name;
    EXPECT_NEAR(found.value, drawn.truth.at(name), 3 * found.error) << name;
  }
  EXPECT_LT(result.held_out.after, 0.2 * result.held_out.before);
  EXPECT_EQ(result.held_out.windows, 13u);

  // What it writes is what a run takes.
  const config::Config known = Known("go2");
  const Replay replay = ReplayOf(known);
  const Basis basis(known.robots[0].spec, replay.bench(), true);
  const config::Config fitted = config::LoadConfig(
      {.robot = "go2",
       .files = {},
       .trees = {schema::ParseYaml(ResultYaml(result, basis, {&drawn.samples, 1}), "fitted.yaml")},
       .sets = {}},
      UNDERSTUDY_SOURCE_DIR);
  EXPECT_NEAR(fitted.robots[0].spec.dynamics.delay, Of(result, "delay").value, 1e-6);
  EXPECT_NEAR(fitted.robots[0].spec.dynamics.fitted.at(2).armature,
              Of(result, "armature FR_calf").value, 1e-6);
}

TEST_F(DrawnTest, DoesNotTellKdFromDampingWhereOneKdWasCommanded) {
  ExcitationSpec excitation = kShortExcitation;
  excitation.seconds = 2;
  const Drawn drawn = Draw("go2", 2, excitation);
  const Identification result =
      IdentifiedBy(drawn, {.parameters = {"damping", "kd_share"}, .hold_out = 0.6}, false);
  for (const char* joint : {"hip", "thigh", "calf"}) {
    const Found& refused = Of(result, std::string("kd_share ") + joint);
    EXPECT_FALSE(refused.told);
    EXPECT_EQ(refused.value, 1);
    EXPECT_THAT(refused.why, HasSubstr("different kd"));
    EXPECT_TRUE(Of(result, std::string("damping ") + joint).told);
  }
}

TEST_F(DrawnTest, RefusesWhatAJointThatDoesNotMoveCannotTell) {
  ExcitationSpec excitation = kShortExcitation;
  excitation.motors = {3};
  const Drawn drawn = Draw("go2", 3, excitation);
  const Identification result =
      IdentifiedBy(drawn, {.parameters = {"damping"}, .hold_out = 0.6}, true);
  EXPECT_TRUE(Of(result, "damping FL_hip").told);
  const Found& still = Of(result, "damping FR_calf");
  EXPECT_FALSE(still.told);
  EXPECT_THAT(still.why, HasSubstr("move faster"));
}

}  // namespace
}  // namespace understudy::identify
