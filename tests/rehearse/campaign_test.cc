#include "rehearse/campaign.h"

#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/files.h"
#include "rehearse/campaign_outputs.h"
#include "rehearse/run_campaign.h"
#include "rehearse/scenario.h"
#include "tests/rehearse/rehearse_fixture.h"
#include "tests/support/temporary_folder.h"

namespace understudy::rehearse {
namespace {

using judge::Outcome;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr char kText[] =
    "scenario: 'Title <&>'\nrobot: go2\nduration: 1\nexpect: []\n"
    "vary:\n"
    "  grid:\n"
    "    terrain.friction: {from: 0.1, to: 1, count: 10}\n"
    "    scene: [flat, rough]\n"
    "    seed: {from: 1, to: 3}\n";

std::string VerdictJson(double margin, double value, const std::string& stopped = "") {
  const char* outcome = margin < 0 ? "failed" : "passed";
  const nlohmann::json told = {{"seconds", 2.5},
                               {"stopped", stopped},
                               {"verdicts",
                                {{{"name", "high"},
                                  {"outcome", outcome},
                                  {"explanation", "base.height was so"},
                                  {"margin", margin},
                                  {"value", value},
                                  {"unit", "m"}},
                                 {{"name", "heard"},
                                  {"outcome", "passed"},
                                  {"explanation", "it happened"},
                                  {"margin", nullptr},
                                  {"value", 1},
                                  {"unit", ""}}}}};
  return told.dump();
}

// Slippery and rough ground is what fails.
Campaign Example() {
  Campaign campaign{.head = {.title = "Title <&>", .scenario = "s.yaml", .text = kText},
                    .plan = PlanOf(kText, "s.yaml")};
  for (std::size_t run = 1; run <= campaign.plan.size(); ++run) {
    const std::vector<Setting> settings = campaign.plan.Of(run);
    const double friction = std::stod(settings[0].text);
    const bool rough = settings[1].text == "rough";
    const double margin = friction - (rough ? 0.45 : 0.15);
    RunResult result = ReadRun(run, settings, margin < 0 ? 10 : 0, VerdictJson(margin, 0.5), "");
    result.repeat = campaign.head.Repeat(run);
    campaign.results.push_back(std::move(result));
  }
  campaign.summary = Summarize(campaign.plan, campaign.results);
  return campaign;
}

// Brown, Cai and DasGupta (Statistical Science 16, 2001) and by hand.
TEST(WilsonIntervalTest, IsThatOfTheLiterature) {
  const Share eight = WilsonInterval(8, 10);
  EXPECT_NEAR(eight.low, 0.4902, 1e-4);
  EXPECT_NEAR(eight.high, 0.9433, 1e-4);
  const Share none = WilsonInterval(0, 10), all = WilsonInterval(10, 10);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 0.2775, 1e-4);
  EXPECT_NEAR(all.low, 0.7225, 1e-4);
  EXPECT_EQ(all.high, 1);
  EXPECT_EQ(WilsonInterval(0, 0).high, 1);
}

TEST(ReadRunTest, TakesTheVerdictOfTheExitCode) {
  EXPECT_EQ(ReadRun(1, {}, 0, VerdictJson(1, 1), "").outcome, Outcome::kPassed);
  EXPECT_EQ(ReadRun(1, {}, 10, VerdictJson(-1, 1), "").outcome, Outcome::kFailed);
  EXPECT_EQ(ReadRun(1, {}, 11, VerdictJson(1, 1), "").outcome, Outcome::kNotJudged);
}

TEST(ReadRunTest, ACrashIsAFailureThatSaysHow) {
  const RunResult crashed = ReadRun(1, {}, 139, "", "");
  EXPECT_EQ(crashed.outcome, Outcome::kFailed);
  EXPECT_EQ(crashed.broken, "ended by signal 11");
  EXPECT_EQ(ReadRun(1, {}, 3, "", "s.yaml:1: no").broken, "exit code 3: s.yaml:1: no");
  EXPECT_EQ(ReadRun(1, {}, 0, "{\"verd", "").broken, "exit code 0");
  EXPECT_EQ(ReadRun(1, {}, 0, "[]", "").outcome, Outcome::kFailed);
}

TEST(ReadRunTest, MarginsOfAllUnitsCompareByWhatWasMeasured) {
  const RunResult result = ReadRun(1, {}, 0, VerdictJson(0.1, 0.4), "");
  EXPECT_NEAR(*result.verdicts[0].relative, 0.2, 1e-12);
  EXPECT_EQ(result.verdicts[1].relative, std::nullopt);
  EXPECT_EQ(result.Worst()->name, "high");
}

TEST(RunLineTest, ComesBackAsItWas) {
  RunResult result = ReadRun(7, {{"$a", "[1, 2]"}}, 10, VerdictJson(-0.25, 0.5), "");
  result.kept = true;
  result.repeat = "understudy";
  const std::string line = RunLine(result);
  EXPECT_EQ(std::ranges::count(line, '\n'), 1);
  const auto back = ParseRun(line);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(RunLine(*back), line);
  EXPECT_EQ(back->settings, result.settings);
  for (const char* bad : {"", "{", "[]", "{\"run\": \"a\"}", "{\"run\": 1}", "null"}) {
    EXPECT_EQ(ParseRun(bad), std::nullopt) << bad;
  }
}

TEST(GroupsTest, FewValuesAreToldApartAndManyNumbersByRange) {
  const auto groups = [](const std::string& vary) {
    return Groups(Plan(schema::ParseYaml(vary, "v")).axes()[0]);
  };
  EXPECT_THAT(groups("grid: {a: [x, y]}").labels(), ElementsAre("x", "y"));
  const Groups parts = groups("random: {a: {from: 0, to: 6}}\nruns: 2");
  EXPECT_THAT(parts.labels(), SizeIs(6));
  EXPECT_EQ(parts.Of("0"), 0U);
  EXPECT_EQ(parts.Of("2.5"), 2U);
  EXPECT_EQ(parts.Of("6"), 5U);
  EXPECT_THAT(groups("random: {a: {from: 1, to: 3, whole: true}}\nruns: 2").labels(),
              ElementsAre("1", "2", "3"));
}

TEST(SummaryTest, CountsByOutcomeAndValueWithoutSeeds) {
  const CampaignSummary summary = Example().summary;
  EXPECT_EQ(summary.planned, 60U);
  EXPECT_EQ(summary.tally.failed, 3U + 12U);
  ASSERT_THAT(summary.axes, SizeIs(2));
  EXPECT_EQ(summary.axes[1].key, "scene");
  EXPECT_EQ(summary.axes[1].tallies[1].failed, 12U);
  ASSERT_THAT(summary.expectations, SizeIs(2));
  EXPECT_THAT(summary.expectations[0].worst, SizeIs(5));
  EXPECT_EQ(summary.expectations[1].worst.size(), 0U);
}

TEST(SummaryTest, TheFailuresComeFirst) {
  const Campaign campaign = Example();
  for (std::size_t i = 0; i < 60; ++i) {
    const Outcome outcome = campaign.results[campaign.summary.order[i]].outcome;
    EXPECT_EQ(outcome, i < 15 ? Outcome::kFailed : Outcome::kPassed);
  }
}

TEST(SummaryTest, FailuresShareWhatMakesThemFail) {
  const CampaignSummary summary = Example().summary;
  ASSERT_THAT(summary.of_failed, Not(IsEmpty()));
  EXPECT_EQ(summary.of_failed[0].key, "terrain.friction");
  EXPECT_EQ(summary.of_failed[0].label, "0.1");
  EXPECT_EQ(summary.of_failed[0].there, 6U);
  EXPECT_EQ(summary.of_failed[0].with, 6U);
  for (const SharedValue& one : summary.of_failed) EXPECT_LT(one.chance, 0.05) << one.label;
  EXPECT_EQ(summary.worst.size(), 6U);
}

TEST(SummaryTest, FailuresThatShareNothingAreNotSaidTo) {
  Campaign campaign = Example();
  for (std::size_t i = 0; i < campaign.results.size(); ++i) {
    campaign.results[i].outcome = i % 7 == 0 ? Outcome::kFailed : Outcome::kPassed;
  }
  EXPECT_THAT(Summarize(campaign.plan, campaign.results).of_failed, IsEmpty());
}

TEST(CampaignOutputsTest, TheLinesHaveFailuresRatesAndTheSum) {
  const std::string text = CampaignText(Example(), false, true);
  EXPECT_THAT(text, HasSubstr("FAIL  1  terrain.friction=0.1 scene=flat seed=1  high: "
                              "base.height was so; margin -0.05 m"));
  EXPECT_LT(text.find("FAIL  22"), text.find("PASS  "));
  EXPECT_THAT(text, HasSubstr("and 35 more that passed"));
  EXPECT_THAT(text, HasSubstr("18 of 30  60.0 % (42.3 to 75.4)"));
  EXPECT_THAT(text, HasSubstr("45 passed, 15 failed, 0 not judged of 60 runs: 75.0 %"));
  EXPECT_THAT(CampaignText(Example(), false, false), Not(HasSubstr("more that passed")));
}

TEST(CampaignOutputsTest, TheReportHasAMapAndNeedsNothingElse) {
  const std::string html = CampaignHtml(Example());
  EXPECT_THAT(html, AllOf(HasSubstr("Title &lt;&amp;&gt;"), HasSubstr("class=\"map\""),
                          HasSubstr("62.8 to 84.2 %"), HasSubstr("share</h2>"),
                          HasSubstr("understudy rehearse s.yaml --run 1")));
  for (const char* outside : {"http:", "https:", "<script", "<link", "<img", "url("}) {
    EXPECT_THAT(html, Not(HasSubstr(outside)));
  }
}

TEST(CampaignOutputsTest, JsonHasCountsRatesAndWhatIsShared) {
  const auto told = nlohmann::json::parse(CampaignJson(Example()));
  EXPECT_EQ(told["failed"], 15);
  EXPECT_EQ(told["missing"], 0);
  EXPECT_EQ(told["rate"], 0.75);
  EXPECT_EQ(told["failed_runs"].size(), 15U);
  EXPECT_EQ(told["keys"][1]["values"][1]["failed"], 12);
  EXPECT_NEAR(told["expectations"][0]["worst"][0]["margin"], -0.35, 1e-12);
}

TEST(ShardTest, IsOneOfSeveral) {
  EXPECT_EQ(ReadShard("2/8").index, 2U);
  EXPECT_EQ(ReadShard("2/8").count, 8U);
  for (const char* bad : {"", "2", "0/2", "3/2", "1/0", "a/b", "1/2/3", "-1/2", " 1/2"}) {
    EXPECT_THAT(config::ErrorOf([&] { ReadShard(bad); }), HasSubstr("expected I/N")) << bad;
  }
}

TEST(ProgressTest, SaysWhatIsLeftOnceItKnows) {
  Progress progress{.done = 37, .of = 200, .tally = {.passed = 35, .failed = 2}, .elapsed = 12};
  EXPECT_EQ(ProgressText(progress),
            "37 of 200: 35 passed, 2 failed; 12 s, time left not known yet");
  progress.left = 53;
  EXPECT_THAT(ProgressText(progress), HasSubstr("12 s, about 53 s left"));
  progress.left = 12'000;
  EXPECT_THAT(ProgressText(progress), HasSubstr("about 3 h 20 min left"));
}

// Campaigns of a shell script in place of Understudy: $4 is the number of the run, $6 its folder.
class PlayTest : public testing::Test {
 protected:
  CampaignOptions Options(const std::string& out, const std::string& script) const {
    const auto file = folder_.Write("play.sh", "#!/bin/sh\n" + script);
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return {.out = folder_.path() / out, .jobs = 4, .program = file};
  }
  // A verdict that fails for every third run.
  static std::string Judges() {
    return "echo \"run $4\" >> \"$(dirname \"$0\")/played\"\n"
           "if [ $(($4 % 3)) = 0 ]; then echo '" +
           VerdictJson(-1, 1) +
           "' > \"$6/verdict.json\"; exit 10; fi\n"
           "echo '" +
           VerdictJson(1, 1) + "' > \"$6/verdict.json\"\n";
  }
  std::size_t Plays() const {
    const std::string text = FileText(folder_.path() / "played");
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
  }

  test::TemporaryFolder folder_;
  const CampaignHead head_{.title = "T", .scenario = "s.yaml", .text = kText};
  const Plan plan_ = PlanOf(kText, "s.yaml");
};

TEST_F(PlayTest, PlaysEveryRunOnceAndKeepsTheFoldersOfFailures) {
  const CampaignOptions options = Options("a", Judges());
  const Played played = PlayCampaign(head_, plan_, options);
  EXPECT_EQ(played.tally.failed, 20U);
  EXPECT_EQ(played.tally.passed, 40U);
  EXPECT_TRUE(std::filesystem::exists(options.out / "runs/000003/verdict.json"));
  EXPECT_FALSE(std::filesystem::exists(options.out / "runs/000004"));
  EXPECT_THAT(ReadCampaign(options.out).results, SizeIs(60));
  // Again, nothing is left to play.
  EXPECT_EQ(PlayCampaign(head_, plan_, options).found, 60U);
  EXPECT_EQ(Plays(), 60U);
}

TEST_F(PlayTest, WhatWasInterruptedGoesOnWithTheSameReport) {
  CampaignOptions options = Options("a", Judges());
  std::size_t ended = 0;
  options.on_result = [&ended](const RunResult&) { ++ended; };
  options.interrupted = [&ended] { return ended >= 10; };
  const Played part = PlayCampaign(head_, plan_, options);
  EXPECT_GE(part.missing, 45U);
  options.interrupted = {};
  const Played rest = PlayCampaign(head_, plan_, options);
  EXPECT_EQ(rest.found, 60 - part.missing);
  EXPECT_EQ(rest.tally.all(), 60U);
  const CampaignOptions whole = Options("b", Judges());
  PlayCampaign(head_, plan_, whole);
  EXPECT_EQ(CampaignHtml(ReadCampaign(options.out)), CampaignHtml(ReadCampaign(whole.out)));
}

TEST_F(PlayTest, ARunThatWasInterruptedLeavesNothing) {
  const CampaignOptions options =
      Options("a", "echo '" + VerdictJson(1, 1, "interrupted") + "' > \"$6/verdict.json\"\n");
  EXPECT_EQ(PlayCampaign(head_, plan_, options).missing, 60U);
  EXPECT_THAT(ReadCampaign(options.out).results, IsEmpty());
  // Also one that had not come so far as to say so.
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    const CampaignOptions early = Options(signal, std::string("kill -") + signal + " $$\n");
    EXPECT_EQ(PlayCampaign(head_, plan_, early).missing, 60U) << signal;
  }
}

TEST_F(PlayTest, ShardsMergeToTheSameBytes) {
  CampaignOptions whole = Options("whole", Judges());
  PlayCampaign(head_, plan_, whole);
  WriteReports(ReadCampaign(whole.out), whole.out);
  std::vector<std::filesystem::path> parts;
  for (std::size_t i = 1; i <= 3; ++i) {
    CampaignOptions part = Options("part" + std::to_string(i), Judges());
    part.shard = {.index = i, .count = 3};
    part.jobs = i;
    EXPECT_EQ(PlayCampaign(head_, plan_, part).tally.all(), 20U);
    parts.push_back(part.out);
  }
  const auto merged = folder_.path() / "merged";
  MergeCampaigns(parts, merged);
  WriteReports(ReadCampaign(merged), merged);
  for (const char* file :
       {"report.html", "verdict.json", "junit.xml", "runs.jsonl", "runs.txt", "campaign.json"}) {
    EXPECT_EQ(FileText(merged / file), FileText(whole.out / file)) << file;
    EXPECT_FALSE(FileText(merged / file).empty()) << file;
  }
  EXPECT_TRUE(std::filesystem::exists(merged / "runs/000003/verdict.json"));
}

TEST_F(PlayTest, ACrashIsOneFailedLine) {
  const CampaignOptions options = Options(
      "a", "[ $4 = 5 ] && kill -SEGV $$\n[ $4 = 6 ] && { echo '[12:00] error: no'; exit 4; }\n" +
               Judges());
  EXPECT_EQ(PlayCampaign(head_, plan_, options).tally.all(), 60U);
  const Campaign campaign = ReadCampaign(options.out);
  EXPECT_EQ(campaign.results[4].broken, "ended by signal 11");
  EXPECT_EQ(campaign.results[5].broken, "exit code 4: error: no");
}

TEST_F(PlayTest, WhatKeepsEveryRunFromBeginningEndsTheCampaign) {
  const CampaignOptions options = Options("a", "echo 'understudy: no namespace'; exit 5\n");
  try {
    PlayCampaign(head_, plan_, options);
    ADD_FAILURE() << "went on";
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("could not begin: no namespace"));
    EXPECT_EQ(error.exit_code(), 5);
  }
  EXPECT_THAT(ReadCampaign(options.out).results, IsEmpty());
}

TEST_F(PlayTest, AFolderIsOfOneCampaign) {
  CampaignOptions options = Options("a", Judges());
  PlayCampaign(head_, plan_, options);
  CampaignHead other = head_;
  other.options = {"--set", "gate.timeout=1"};
  EXPECT_THAT(config::ErrorOf([&] { PlayCampaign(other, plan_, options); }),
              HasSubstr("has results of another campaign"));
  options.again = true;
  EXPECT_EQ(PlayCampaign(other, plan_, options).found, 0U);
  // Of the same campaign only the shard's own runs are played again.
  const std::size_t plays = Plays();
  options.shard = {.index = 2, .count = 3};
  EXPECT_EQ(PlayCampaign(other, plan_, options).tally.all(), 20U);
  EXPECT_EQ(Plays(), plays + 20);
  EXPECT_THAT(ReadCampaign(options.out).results, SizeIs(60));
  EXPECT_THAT(config::ErrorOf([&] { MergeCampaigns({folder_.path()}, folder_.path() / "m"); }),
              HasSubstr("has no campaign.json"));
}

TEST_F(PlayTest, ADamagedResultIsPlayedAnew) {
  const CampaignOptions options = Options("a", Judges());
  PlayCampaign(head_, plan_, options);
  WriteFile(options.out / RunFile(9), "{\"run\": 9");
  EXPECT_EQ(PlayCampaign(head_, plan_, options).found, 59U);
  EXPECT_EQ(Plays(), 61U);
}

}  // namespace
}  // namespace understudy::rehearse
