#include "rehearse/world_evidence.h"

#include <functional>
#include <string>
#include <vector>

#include "tests/rehearse/rehearse_fixture.h"

namespace understudy::rehearse {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Names TwoTinyNames() {
  Names left = TinyNames(), right = TinyNames();
  left.robot = "left";
  right.robot = "right";
  Names both = signals::Joined({left, right});
  both.of_none = true;
  return both;
}

Expectations ReadOfTwo(const std::string& list) {
  return ReadExpectations(schema::ParseYaml(list, "e"), TwoTinyNames());
}

// The left one sinks at 1 s, the right one leans at 1.5 s.
void PlayLeft(Jury* jury) {
  Stage stage(jury->Hearing(0));
  stage.Truth(0, 0.4);
  stage.Event(0.5, "program_prints", R"({"text": "go", "count": 1})");
  stage.Event(0.5, "gate", R"({"state": "damping"})");
  stage.Truth(1, 0.2);
  stage.Truth(2, 0.4);
}
void PlayRight(Jury* jury) {
  Stage stage(jury->Hearing(1));
  stage.Truth(0, 0.4);
  stage.Event(0.25, "gate", R"({"state": "limp"})");
  stage.Event(0.5, "program_prints", R"({"text": "go", "count": 1})");
  stage.Truth(1.5, 0.4, 0.5);
  stage.Truth(2.5, 0.4);
}

constexpr char kClaims[] =
    "[{always: 'left:base.height > 0.3', name: l}, {always: 'right:base.height > 0.3', name: r},\n"
    " {never: 'right:base.tilt > 0.4 and left:base.height > 0.3', name: b},\n"
    " {never: 'right:base.tilt > 0.4 and left:base.height < 0.3', name: c},\n"
    " {count: 'the program prints \"go\"', least: 1, most: 1, name: p}]";

TEST(WorldEvidenceTest, JudgesEachRobotByWhatItsOwnRecordingSays) {
  const Expectations expect = ReadOfTwo(kClaims);
  Jury jury(expect);
  PlayLeft(&jury);
  PlayRight(&jury);
  jury.Finish();
  using enum judge::Outcome;
  const std::vector<judge::Verdict> verdicts = jury.verdicts();
  EXPECT_EQ(verdicts[0].outcome, kFailed);
  EXPECT_EQ(verdicts[0].worth.at, 1'000'000'000);
  EXPECT_EQ(verdicts[1].outcome, kPassed);
  EXPECT_EQ(verdicts[2].outcome, kFailed) << "from 2 s on, when the left one stands again";
  EXPECT_EQ(verdicts[2].worth.at, 2'000'000'000);
  EXPECT_EQ(verdicts[3].outcome, kFailed) << "at 1.5 s, while the left one lies";
  EXPECT_EQ(verdicts[3].worth.at, 1'500'000'000);
  EXPECT_EQ(verdicts[4].outcome, kPassed) << "both recordings have what the program prints";
}

TEST(WorldEvidenceTest, HowTheRecordingsMixMakesNoDifference) {
  const Expectations expect = ReadOfTwo(kClaims);
  const auto margins = [&expect](const std::vector<std::function<void(Jury*)>>& plays) {
    Jury jury(expect);
    for (const auto& play : plays) play(&jury);
    jury.Finish();
    std::vector<double> all;
    for (const judge::Verdict& verdict : jury.verdicts()) {
      all.push_back(verdict.worth.margin);
      all.push_back(static_cast<double>(verdict.worth.at));
    }
    return all;
  };
  EXPECT_EQ(margins({PlayLeft, PlayRight}), margins({PlayRight, PlayLeft}));
}

TEST(WorldEvidenceTest, AnEventNamesItsRobotAndOneOfTheWorldIsThereOnce) {
  const Expectations expect = ReadOfTwo("[{never: 'left:base.height < 0'}]");
  Jury jury(expect);
  PlayLeft(&jury);
  PlayRight(&jury);
  jury.Finish();
  std::vector<std::string> texts;
  for (const Evidence::Told& told : jury.events()) texts.push_back(told.event.text);
  EXPECT_THAT(texts, ElementsAre("right: gate", "program_prints", "left: gate"));
}

TEST(WorldEvidenceTest, TheOutcomeOfARobotIsTheWorstThatNamesIt) {
  const Expectations expect = ReadOfTwo(
      "[{always: 'left:base.height > 0'}, {always: 'left:base.height > 0.3'},\n"
      " {always: the program prints \"go\"}]");
  const auto passed = Ruling{.verdict = {.outcome = judge::Outcome::kPassed}};
  const auto failed = Ruling{.verdict = {.outcome = judge::Outcome::kFailed}};
  const Judged judged{.rulings = {passed, failed, failed}};
  EXPECT_EQ(OutcomeOf(0, expect, judged), judge::Outcome::kFailed);
  EXPECT_EQ(OutcomeOf(1, expect, judged), std::nullopt);
}

TEST(WorldEvidenceTest, ASignalOfSeveralRobotsNamesItsOwn) {
  const auto error = [](const std::string& claim) {
    return config::ErrorOf([&] { ReadOfTwo("[{always: '" + claim + "'}]"); });
  };
  EXPECT_THAT(error("base.height > 0"), HasSubstr("expected such as left:base.height"));
  EXPECT_THAT(error("up:base.height > 0"), HasSubstr("up"));
  EXPECT_EQ(error("program.exit_code is 0"), "");
}

}  // namespace
}  // namespace understudy::rehearse
