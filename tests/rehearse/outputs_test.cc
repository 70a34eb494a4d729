#include "rehearse/outputs.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "rehearse/rehearse.h"
#include "tests/rehearse/rehearse_fixture.h"

namespace understudy::rehearse {
namespace {

using testing::HasSubstr;
using testing::Not;

// One that passes, one that fails, one that is not judged.
class OutputsTest : public testing::Test {
 protected:
  OutputsTest()
      : expect_(ReadExpect("- {always: base.height > 0.2, name: 'up & \"<about>\"'}\n"
                           "- {always: base.height > 35 cm, name: high, says: It is high}\n"
                           "- {always: base.height > 0.1, to: 9, name: long}\n")) {
    Jury jury(expect_);
    Stage stage(jury.Hearing(0));
    stage.Truth(0, 0.4);
    stage.Truth(1, 0.3);
    stage.Event(1, "gate", R"({"state": "damping"})");
    stage.Truth(2, 0.4);
    jury.Finish();
    judged_.end = 2;
    judged_.events = jury.events();
    judged_.whole = {{{0, 0.4}, {1, 0.4}, {1, 0.3}, {2, 0.3}}};
    for (const judge::Verdict& verdict : jury.verdicts()) {
      const bool open = verdict.outcome == judge::Outcome::kNotJudged;
      judged_.rulings.push_back({.verdict = verdict, .why = open ? "it ended" : ""});
      judged_.closeups.push_back({{.from = 0.5, .to = 1.5, .points = {{0.5, 0.4}, {1, 0.3}}}});
    }
  }

  const Occasion occasion_{.title = "Title", .repeat = "understudy rehearse x"};
  Expectations expect_;
  Judged judged_;
};

TEST_F(OutputsTest, ALineHasTheOutcomeWhatDecidedAndTheMargin) {
  const std::string lines = TellLines(occasion_, expect_, judged_, false);
  EXPECT_THAT(lines,
              HasSubstr("PASS  up & \"<about>\"  base.height was 0.3 m at 1.000 s; margin 0.1 m"));
  EXPECT_THAT(lines,
              HasSubstr("FAIL  high            base.height was 30 cm at 1.000 s; margin -5 cm"));
  EXPECT_THAT(lines, HasSubstr("NONE  long            it ended"));
  EXPECT_THAT(lines, HasSubstr("1 passed, 1 failed, 1 not judged in 2.000 s"));
}

TEST(OutputsTextTest, TellsAnExitCodeThatIsNotTheOneAskedForAsANumberAndAStateByItsWord) {
  const Expectations expect = ReadExpect(
      "- {final: program.exit_code is 0, name: ends well}\n"
      "- {final: gate is limp, name: lets go}\n");
  Jury jury(expect);
  Stage stage(jury.Hearing(0));
  stage.Truth(0, 0.4);
  stage.Event(1, "program_end", R"({"code": 3})");
  stage.Event(1, "gate", R"({"state": "damping"})");
  stage.Truth(2, 0.4);
  jury.Finish();
  const std::vector<judge::Verdict> verdicts = jury.verdicts();
  EXPECT_THAT(Explain(expect.list[0], {.verdict = verdicts[0]}),
              testing::StartsWith("program.exit_code was 3 at "));
  EXPECT_THAT(Explain(expect.list[1], {.verdict = verdicts[1]}),
              testing::StartsWith("not gate is limp at "));
}

TEST_F(OutputsTest, JsonHasNumbersAndNullWhereThereIsNone) {
  const auto told = nlohmann::json::parse(TellJson(occasion_, expect_, judged_));
  EXPECT_EQ(told["failed"], 1);
  EXPECT_NEAR(told["verdicts"][1]["margin"], -5, 1e-9);
  EXPECT_EQ(told["verdicts"][1]["unit"], "cm");
  EXPECT_EQ(told["verdicts"][1]["at"], 1);
  EXPECT_TRUE(told["verdicts"][2]["margin"].is_null());
  EXPECT_EQ(told["verdicts"][2]["outcome"], "not judged");
}

TEST_F(OutputsTest, EachOfSeveralRobotsHasItsVerdict) {
  expect_.robots = {"left", "right", "idle"};
  expect_.signals = {{.name = "left:base.height"}, {.name = "right:base.height", .robot = 1}};
  expect_.list[1].signals = {1};
  expect_.list[2].signals = {0};
  judged_.rulings[2] = judged_.rulings[0];
  const std::string lines = TellLines(occasion_, expect_, judged_, false);
  EXPECT_THAT(lines,
              HasSubstr("  PASS  left\n  FAIL  right\n        idle  no expectation names it"));
  const auto robots = nlohmann::json::parse(TellJson(occasion_, expect_, judged_))["robots"];
  EXPECT_EQ(robots[0]["outcome"], "passed");
  EXPECT_EQ(robots[1]["name"], "right");
  EXPECT_EQ(robots[1]["outcome"], "failed");
  EXPECT_TRUE(robots[2]["outcome"].is_null());
  EXPECT_THAT(TellJunit(occasion_, expect_, judged_),
              HasSubstr("<property name=\"verdict of right\" value=\"failed\"/>"));
}

TEST_F(OutputsTest, PageAndJsonHaveTheDamageSheetWhereThereIsOne) {
  EXPECT_THAT(TellJson(occasion_, expect_, judged_), HasSubstr("\"damage\": null"));
  EXPECT_THAT(TellHtml(occasion_, expect_, judged_), Not(HasSubstr("done to the robot")));
  judged_.damage = {record::Damage{.sheet = {.motors = {{.at_torque_limit = 0.25}}, .falls = 2},
                                   .joints = {"<hip>"},
                                   .torque_limit = {23.7},
                                   .speed_limit = {30},
                                   .jump_limit = {0.4},
                                   .limits = {{"shock", 39, "m/s²", "assumed: <so>"}}}};
  const auto damage = nlohmann::json::parse(TellJson(occasion_, expect_, judged_))["damage"];
  EXPECT_EQ(damage["falls"], 2);
  EXPECT_EQ(damage["motors"][0]["joint"], "<hip>");
  EXPECT_EQ(damage["motors"][0]["torque_limit"], 23.7);
  EXPECT_EQ(damage["motors"][0]["jump_limit"], 0.4);
  EXPECT_EQ(damage["limits"][0]["source"], "assumed: <so>");
  const std::string html = TellHtml(occasion_, expect_, judged_);
  EXPECT_THAT(html, HasSubstr("2 falls"));
  EXPECT_THAT(html, HasSubstr("<code>&lt;hip&gt;</code>"));
  EXPECT_THAT(html, HasSubstr("<b>0.25 s</b> at 23.7 N·m"));
  EXPECT_THAT(html, HasSubstr("39 m/s²</td><td>assumed: &lt;so&gt;</td>"));
}

TEST_F(OutputsTest, ThePageHoldsWhatWasReachedAgainstItsLimit) {
  judged_.damage = {record::Damage{.sheet = {.motors = {{.hottest_c = 30, .largest_jump = 0.5},
                                                        {.at_torque_limit = 0.25, .hottest_c = 41}},
                                             .energy = 2e4,
                                             .shock = 40,
                                             .falls = 0},
                                   .joints = {"hip", "<calf>"},
                                   .torque_limit = {23.7, 45},
                                   .speed_limit = {30, 16},
                                   .jump_limit = {0.6, 0.4},
                                   .limits = {{"shock", 39, "m/s²", ""},
                                              {"energy", 8e5, "J", ""},
                                              {"falls", 0, "", ""},
                                              {"at_torque_limit", std::nan(""), "N·m", ""},
                                              {"hottest", 105, "°C", ""},
                                              {"largest_jump", std::nan(""), "rad", ""}}}};
  const auto html = [this] { return TellHtml(occasion_, expect_, judged_); };
  for (const char* row : {
           "shock</td><td class=\"number beyond\">40 m/s²</td><td class=\"number\">39 m/s²</td>",
           "energy</td><td class=\"number\">20 kJ</td><td class=\"number\">800 kJ</td>",
           "falls</td><td class=\"number\">0</td><td class=\"number\">0</td>",
           "at_torque_limit</td><td class=\"number beyond\">0.25 s, &lt;calf&gt;</td>"
           "<td class=\"number\">each motor's</td>",
           "hottest</td><td class=\"number\">41 °C, &lt;calf&gt;</td>",
           "largest_jump</td><td class=\"number\">0.5 rad, hip</td>",
       }) {
    EXPECT_THAT(html(), HasSubstr(row));
  }
  // Of the motor that jumps less, that is too much.
  judged_.damage[0]->sheet.motors[1].largest_jump = 0.45;
  EXPECT_THAT(
      html(),
      HasSubstr("largest_jump</td><td class=\"number beyond\">0.45 rad, &lt;calf&gt;</td>"));
}

TEST_F(OutputsTest, WhatDidNotEndInItsTimeHasFailed) {
  Occasion occasion = occasion_;
  judged_.rulings.resize(1);
  judged_.rulings[0].verdict.outcome = judge::Outcome::kPassed;
  expect_.list.resize(1);
  EXPECT_THAT(TellHtml(occasion, expect_, judged_), HasSubstr("<h1><span class=\"word passed\">"));
  judged_.failures = {{"the rehearsal", "did not end within 8 s of wall time"}};
  EXPECT_THAT(TellHtml(occasion, expect_, judged_), HasSubstr("<h1><span class=\"word failed\">"));
  EXPECT_THAT(TellLines(occasion, expect_, judged_, false),
              HasSubstr("FAIL  the rehearsal did not end within 8 s of wall time"));
  EXPECT_THAT(TellJunit(occasion, expect_, judged_), HasSubstr("tests=\"2\" failures=\"1\""));
}

TEST_F(OutputsTest, JunitHasAFailureForWhatFailedAndASkipForWhatIsNotJudged) {
  const std::string xml = TellJunit(occasion_, expect_, judged_);
  EXPECT_THAT(xml, HasSubstr("tests=\"3\" failures=\"1\""));
  EXPECT_THAT(xml, HasSubstr("name=\"up &amp; &quot;&lt;about&gt;&quot;\""));
  EXPECT_THAT(xml, HasSubstr("<failure type=\"failed\" message=\"base.height was 30 cm"));
  EXPECT_THAT(xml, HasSubstr("<skipped message=\"it ended\"/>"));
}

TEST_F(OutputsTest, ThePageNeedsNothingElseAndQuotesAllTexts) {
  const std::string html = TellHtml(occasion_, expect_, judged_);
  EXPECT_THAT(html, HasSubstr("<svg"));
  EXPECT_THAT(html, HasSubstr("up &amp; &quot;&lt;about&gt;&quot;"));
  EXPECT_THAT(html, Not(HasSubstr("<about>")));
  for (const char* outside : {"http:", "https:", "<script", "<link", "<img", "url("}) {
    EXPECT_THAT(html, Not(HasSubstr(outside)));
  }
}

TEST_F(OutputsTest, ThePageHasThePicturesInItself) {
  Occasion occasion = occasion_;
  occasion.pictures = {.drawn = {{.at = 1.5, .png = "Man"}, {2, "Ma"}, {3, "M\xff"}},
                       .why_not = "one > is missing"};
  const std::string html = TellHtml(occasion, expect_, judged_);
  EXPECT_THAT(html, HasSubstr("<img alt=\"The robot at 1.500 s\" "
                              "src=\"data:image/png;base64,TWFu\">"));
  EXPECT_THAT(html, HasSubstr("base64,TWE=\""));
  EXPECT_THAT(html, HasSubstr("base64,Tf8=\""));
  EXPECT_THAT(html, HasSubstr("No more pictures: one &gt; is missing."));
  occasion.pictures.drawn.clear();
  EXPECT_THAT(TellHtml(occasion, expect_, judged_), HasSubstr("No pictures: one &gt; is missing."));
  // What the robot saw stands beside it, also where it could not be drawn itself.
  occasion.pictures.drawn = {
      {.at = 1.5, .png = "Man", .camera = "a>b", .seen_png = "Ma"},
      {.at = 2.5, .png = {}, .camera = {}, .seen_png = {}, .lidar = "<svg/>"}};
  const std::string seen = TellHtml(occasion, expect_, judged_);
  EXPECT_THAT(seen, HasSubstr("<img alt=\"What its camera a&gt;b saw at 1.500 s\" "
                              "src=\"data:image/png;base64,TWE=\"><figcaption>1.500 s: what its "
                              "camera a&gt;b saw"));
  EXPECT_THAT(seen, HasSubstr("<figure><svg/><figcaption>2.500 s: what its lidar saw"));
  EXPECT_THAT(seen, Not(HasSubstr("The robot at 2.500 s")));
  // A picture tells what was decided at its instant.
  judged_.rulings[0].verdict.worth.at = 1'500'000'000;
  occasion.pictures.drawn = {{.at = 1.5, .png = "Man"}};
  const std::string name = Escaped(expect_.list[0].name);
  EXPECT_THAT(TellHtml(occasion, expect_, judged_),
              HasSubstr("<figcaption>1.500 s: " + name + "</figcaption>"));
}

TEST(ShellTextTest, QuotesWhatAShellWouldTakeApart) {
  EXPECT_EQ(ShellText({"a", "b c", "it's", ""}), "a 'b c' 'it'\\''s' ''");
}

}  // namespace
}  // namespace understudy::rehearse
