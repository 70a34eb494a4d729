#include "policy/definition.h"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "policy/terms.h"

namespace understudy::policy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// As the vendor's exporter writes it, for a robot of three joints.
constexpr const char* kExported = R"(joint_ids_map: [2, 0, 1]
step_dt: 0.02
stiffness: [20.0, 30.0, 40.0]
damping: [1.0, 2.0, 3.0]
default_joint_pos: [0.1, -0.2, 0.3]
commands:
  base_velocity:
    ranges:
      lin_vel_x: [-0.5, 1.0]
      lin_vel_y: [-0.3, 0.3]
      ang_vel_z: [-0.2, 0.2]
      heading: null
actions:
  JointPositionAction:
    clip: null
    joint_names: [.*]
    scale: [0.25, 0.5, 0.75]
    offset: [0.1, -0.2, 0.3]
    joint_ids: !!python/object/apply:builtins.slice [null, null, null]
observations:
  base_ang_vel:
    params: {}
    clip: null
    scale: [0.2, 0.2, 0.2]
    history_length: 5
  velocity_commands:
    params: {command_name: base_velocity}
    clip: [-1, 1]
    scale: null
    history_length: 1
  joint_vel_rel:
    params: {asset_cfg: {joint_ids: [2, 0]}}
    clip: null
    scale: 0.05
    history_length: 0
  gait_phase:
    params: {period: 0.8}
    clip: null
    scale: [1.0, 1.0]
  last_action:
    params: {}
    clip: null
    scale: [1.0, 1.0, 1.0]
)";

Definition Parsed(const std::string& text) { return ParseDefinition(text, "/made/deploy.yaml"); }

// The text with `from`, which is in it, replaced.
std::string With(const std::string& from, const std::string& to) {
  std::string text = kExported;
  text.replace(text.find(from), from.size(), to);
  return text;
}

std::string WhyNot(const std::string& text) {
  try {
    Parsed(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(DefinitionTest, ReadsWhatTheVendorsExporterWrites) {
  const Definition read = Parsed(kExported);
  EXPECT_THAT(read.slots, ElementsAre(2, 0, 1));
  EXPECT_EQ(read.step_dt, 0.02F);
  EXPECT_THAT(read.stiffness, ElementsAre(20, 30, 40));
  EXPECT_THAT(read.damping, ElementsAre(1, 2, 3));
  EXPECT_THAT(read.default_q, ElementsAre(0.1F, -0.2F, 0.3F));
  EXPECT_THAT(read.velocity,
              ElementsAre(Limits{-0.5F, 1}, Limits{-0.3F, 0.3F}, Limits{-0.2F, 0.2F}));
  EXPECT_THAT(read.action.joints, ElementsAre(0, 1, 2));
  EXPECT_THAT(read.action.scale, ElementsAre(0.25F, 0.5F, 0.75F));
  EXPECT_THAT(read.action.clip, ElementsAre());
  ASSERT_EQ(read.terms.size(), 5U);
  EXPECT_EQ(read.terms[0].row->name, "base_ang_vel");
  EXPECT_EQ(read.terms[0].history, 5U);
  EXPECT_EQ(read.terms[0].clip, std::nullopt);
  EXPECT_THAT(read.terms[1].scale, ElementsAre(1, 1, 1));
  EXPECT_EQ(read.terms[1].clip, (Limits{-1, 1}));
  EXPECT_THAT(read.terms[2].joints, ElementsAre(2, 0));
  EXPECT_THAT(read.terms[2].scale, ElementsAre(0.05F, 0.05F));
  EXPECT_EQ(read.terms[2].history, 1U) << "0 is the present step alone";
  EXPECT_EQ(read.terms[3].period, 0.8F);
  EXPECT_EQ(Width(read), 5U * 3 + 3 + 2 + 2 + 3);
  EXPECT_FALSE(read.scale_first);
  EXPECT_FALSE(read.history_by_step);
  EXPECT_EQ(read.weights, "/made/deploy.safetensors");
}

TEST(DefinitionTest, ReadsTheKeysOfTheOtherInterpreterToo) {
  const std::string text = With("    history_length: 5\n", "") +
                           "  scale_first: true\n  use_gym_history: true\n" +
                           "understudy: {weights: walk.safetensors, joint_names: [a, b, c]}\n";
  const Definition read = Parsed(text);
  EXPECT_TRUE(read.scale_first);
  EXPECT_TRUE(read.history_by_step);
  EXPECT_EQ(read.weights, "/made/walk.safetensors");
  EXPECT_THAT(read.joint_names, ElementsAre("a", "b", "c"));
  const Definition grouped = Parsed(
      "step_dt: 0.02\nstiffness: [1]\ndamping: [1]\ndefault_joint_pos: [0]\njoint_ids_map: [0.0]\n"
      "actions: {JointPositionAction: {clip: [[-1, 1]], joint_ids: [0]}}\n"
      "observations: {policy: {joint_pos: {params: {}}}}\n");
  ASSERT_EQ(grouped.terms.size(), 1U);
  EXPECT_THAT(grouped.action.clip, ElementsAre(Limits{-1, 1}));
  EXPECT_THAT(grouped.action.scale, ElementsAre(1));
  EXPECT_THAT(grouped.action.offset, ElementsAre(0));
}

TEST(DefinitionTest, NamesFileLineKeyAndNearestWordOfWhatIsWrong) {
  EXPECT_EQ(WhyNot(With("base_ang_vel:", "base_ang_val:")).substr(0, 110),
            "/made/deploy.yaml:22: observations.base_ang_val: unknown observation; did you mean "
            "'base_ang_vel'? (valid: bas");
  EXPECT_EQ(WhyNot(With("[0.25, 0.5, 0.75]", "[0.25, 0.5]")),
            "/made/deploy.yaml:17: actions.JointPositionAction.scale: expected one number for each "
            "of the 3 values, got 2");
  const std::pair<std::string, const char*> rows[] = {
      {"", "expected the keys of a policy's definition"},
      {"- 1\n", "expected the keys"},
      {"{", "deploy.yaml:"},
      {With("step_dt: 0.02\n", ""), "deploy.yaml:1: step_dt: missing"},
      {With("step_dt: 0.02", "step_dt: fast"), ":2: step_dt: expected a number, got fast"},
      {With("step_dt: 0.02", "step_dt: .nan"), "step_dt: expected a number"},
      {With("step_dt: 0.02", "step_dt: 1e99"), "step_dt: expected a number"},
      {With("step_dt: 0.02", "step_dt: 0"), "step_dt: expected more than 0"},
      {With("joint_ids_map: [2, 0, 1]\n", ""), "joint_ids_map: missing"},
      {With("[2, 0, 1]", "[2, 0]"),
       "joint_ids_map: expected one number for each of the 3 joints of default_joint_pos, got 2"},
      {With("[2, 0, 1]", "[2, 0.5, 1]"), "joint_ids_map: expected slots"},
      {With("[2, 0, 1]", "[2, -1, 1]"), "joint_ids_map: expected slots"},
      {With("[20.0, 30.0", "[20.0, -1"), "stiffness.1: expected at least 0"},
      {With("JointPositionAction", "JointVelocityAction"),
       "unknown action; did you mean 'JointPositionAction'?"},
      {With("offset: [0.1, -0.2, 0.3]", "offset: [0.1]"), "offset: expected one number for each"},
      {With("    clip: null\n    joint_names", "    clip: [[0, 1]]\n    joint_names"),
       "clip: expected [least, most] for each of the 3 actions, got 1"},
      {With("clip: [-1, 1]", "clip: [1, -1]"), "velocity_commands.clip: expected [least, most]"},
      {With("joint_ids: [2, 0]", "joint_ids: [2, 3]"),
       "joint_ids.1: expected a whole number from 0 to 2, got 3"},
      {With("joint_ids: [2, 0]", "joint_ids: [2, 2]"), "this joint is listed already"},
      {With("{period: 0.8}", "{}"), "gait_phase.params.period: missing"},
      {With("{period: 0.8}", "{period: 0}"), "period: expected more than 0 s"},
      {With("history_length: 5", "history_length: 5000"),
       "history_length: expected a whole number"},
      {With("      lin_vel_y: [-0.3, 0.3]\n", ""), "ranges.lin_vel_y: missing"},
      {std::string(kExported) + "  use_gym_history: true\n", "the same history_length"},
      {std::string(kExported) + "understudy: {weight: x}\n",
       "understudy.weight: unknown key; did you mean 'weights'?"},
      {std::string(kExported) + "understudy: {joint_names: [a]}\n", "expected a name for each"},
  };
  for (const auto& [text, why] : rows) {
    EXPECT_THAT(WhyNot(text), HasSubstr(why));
    EXPECT_THAT(WhyNot(text), StartsWith("/made/deploy.yaml"));
  }
}

TEST(DefinitionTest, SaysThatAFileIsMissing) {
  try {
    ReadDefinition("/nowhere/deploy.yaml");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "/nowhere/deploy.yaml: expected a policy's definition: no such file, or it is "
                 "empty");
  }
}

TEST(DefinitionTest, EachObservationIsDocumented) {
  std::ifstream file(UNDERSTUDY_SOURCE_DIR "/docs/reference/policies.md");
  std::stringstream page;
  page << file.rdbuf();
  for (const TermRow& row : TermRows()) {
    EXPECT_THAT(page.str(), HasSubstr("| `" + std::string(row.name) + "` |"));
  }
}

}  // namespace
}  // namespace understudy::policy
