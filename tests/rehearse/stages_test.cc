#include "rehearse/stages.h"

#include "config/load.h"
#include "tests/rehearse/rehearse_fixture.h"

namespace understudy::rehearse {
namespace {

using testing::HasSubstr;

std::vector<StageSpec> StagesOf(const std::string& list) {
  return ReadStages(schema::ParseYaml(list, "s"));
}

TEST(StagesTest, HaveTheLimitsThatTheyName) {
  const std::vector<StageSpec> stages = StagesOf(
      "- {name: crawl, torque: 0.3, command_rate: 100}\n- {name: run, joint_margin: 0.1}\n");
  ASSERT_EQ(stages.size(), 2U);
  EXPECT_EQ(stages[0].torque, 0.3);
  EXPECT_EQ(stages[0].command_rate, 100);
  EXPECT_EQ(stages[0].speed, std::nullopt);
  EXPECT_EQ(stages[1].joint_margin, 0.1);
  EXPECT_EQ(stages[1].where, "s:2");
}

TEST(StagesTest, SayWhereAndWhatIsWrongWithTheNearestWord) {
  const std::pair<std::string, const char*> kRows[] = {
      {"[]", "s:1: stages: expected a list of stages"},
      {"- crawl", "s:1: stages: expected a stage"},
      {"- {torque: 0.3}", "s:1: stages: name: missing"},
      {"- {name: a}", "s:1: stages: 'a' has no limit"},
      {"- {name: a, torqe: 0.3}", "s:1: key 'torqe': unknown; did you mean 'torque'?"},
      {"- {name: a, torque: 0}", "s:1: torque: expected a number above 0, up to 1"},
      {"- {name: a, speed: 1.1}", "s:1: speed: expected a number above 0, up to 1"},
      {"- {name: a, speed: 1}\n- {name: a, torque: 1}",
       "s:2: stages: 'a' is the name of that at s:1"},
  };
  for (const auto& [text, error] : kRows) {
    EXPECT_THAT(config::ErrorOf([&text = text] { StagesOf(text); }), HasSubstr(error)) << text;
  }
}

// A ladder of three stages; which of their limits hold is given.
Ladder Made(const std::vector<bool>& holds) {
  Ladder ladder{.stages = StagesOf("- {name: a, torque: 1}\n- {name: b, torque: 1}\n"
                                   "- {name: c, torque: 1}\n")};
  for (std::size_t i = 0; i < holds.size(); ++i) {
    ladder.stage_of.push_back(i);
    ladder.rulings.push_back(
        {.verdict = {.outcome = holds[i] ? judge::Outcome::kPassed : judge::Outcome::kFailed}});
  }
  while (ladder.held < 3 && ladder.Holds(ladder.held)) ++ladder.held;
  return ladder;
}

TEST(LadderTest, GoesUpToTheFirstStageThatDoesNotHold) {
  EXPECT_EQ(LadderText(Made({true, true, true})), "may go up to stage 'c', 3 of 3");
  EXPECT_EQ(LadderText(Made({true, false, true})), "may go up to stage 'a', 1 of 3; next is 'b'");
  EXPECT_EQ(LadderText(Made({false, true, true})), "may go up to no stage; next is 'a'");
}

}  // namespace
}  // namespace understudy::rehearse
