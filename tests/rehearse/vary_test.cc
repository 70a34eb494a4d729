#include "rehearse/vary.h"

#include <cmath>
#include <map>
#include <set>

#include "rehearse/scenario.h"
#include "tests/rehearse/rehearse_fixture.h"
#include "tests/support/temporary_folder.h"

namespace understudy::rehearse {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Plan Read(const std::string& vary) { return Plan(schema::ParseYaml(vary, "v")); }

std::vector<std::string> All(const Plan& plan) {
  std::vector<std::string> all;
  for (std::size_t run = 1; run <= plan.size(); ++run) all.push_back(SettingsText(plan.Of(run)));
  return all;
}

TEST(PlanTest, AGridHasEveryCombinationTheLastKeyFastest) {
  EXPECT_THAT(All(Read("grid: {robot: [go2, b2], seed: {from: 3, to: 5}}")),
              ElementsAre("robot=go2 seed=3", "robot=go2 seed=4", "robot=go2 seed=5",
                          "robot=b2 seed=3", "robot=b2 seed=4", "robot=b2 seed=5"));
}

TEST(PlanTest, AGridCutsARangeIntoEqualSteps) {
  EXPECT_THAT(All(Read("grid: {terrain.friction: {from: 0.2, to: 1, count: 5}}")),
              ElementsAre("terrain.friction=0.2", "terrain.friction=0.4", "terrain.friction=0.6",
                          "terrain.friction=0.8", "terrain.friction=1"));
}

TEST(PlanTest, AListHasItsRowsAndMultipliesTheGrid) {
  EXPECT_THAT(All(Read("list: [{robot: go2, start: lying}, {start: standing, robot: b2}]\n"
                       "grid: {seed: [1, 2]}")),
              ElementsAre("seed=1 robot=go2 start=lying", "seed=1 robot=b2 start=standing",
                          "seed=2 robot=go2 start=lying", "seed=2 robot=b2 start=standing"));
}

TEST(PlanTest, ValuesMayBeListsAndQuotedTexts) {
  EXPECT_THAT(All(Read("grid: {randomization.mass: [[0.8, 0.9], [1, 1.2]]}")),
              ElementsAre("randomization.mass=[0.8, 0.9]", "randomization.mass=[1, 1.2]"));
  EXPECT_THAT(All(Read("grid: {robot.firmware: ['1.3']}")), ElementsAre("robot.firmware='1.3'"));
}

TEST(PlanTest, ALatinHypercubeMeetsEachPartOfEachRangeOnce) {
  const Plan plan = Read("latin: {a: {from: 10, to: 20}, $b: {from: -1, to: 0}}\nruns: 50");
  ASSERT_EQ(plan.size(), 50U);
  std::set<int> parts_of_a, parts_of_b;
  std::vector<double> as, bs;
  for (std::size_t run = 1; run <= 50; ++run) {
    as.push_back(std::stod(plan.Of(run)[0].text));
    bs.push_back(std::stod(plan.Of(run)[1].text));
    parts_of_a.insert(static_cast<int>(std::floor((as.back() - 10) * 5)));
    parts_of_b.insert(static_cast<int>(std::floor((bs.back() + 1) * 50)));
  }
  EXPECT_EQ(parts_of_a.size(), 50U);
  EXPECT_EQ(parts_of_b.size(), 50U);
  // In orders of their own.
  double covariance = 0;
  for (std::size_t i = 0; i < 50; ++i) covariance += (as[i] - 15) * (bs[i] + 0.5) / 50;
  EXPECT_LT(std::abs(covariance), 0.4 * (10 / std::sqrt(12)) * (1 / std::sqrt(12)));
}

TEST(PlanTest, ALatinHypercubeMeetsListedValuesEquallyOften) {
  const Plan plan = Read("latin: {robot: [go2, b2, a2]}\nruns: 30");
  std::map<std::string, int> counts;
  for (const std::string& text : All(plan)) ++counts[text];
  for (const auto& [text, count] : counts) EXPECT_EQ(count, 10) << text;
}

TEST(PlanTest, RandomDrawsStayInTheRangeAndDependOnSeedAndKeyOnly) {
  const std::string friction = "a: {from: 0.3, to: 0.9}";
  const Plan plan = Read("random: {" + friction + ", n: {from: 1, to: 6, whole: true}}\nruns: 300");
  std::set<std::string> faces;
  for (std::size_t run = 1; run <= 300; ++run) {
    const double a = std::stod(plan.Of(run)[0].text);
    EXPECT_TRUE(a >= 0.3 && a <= 0.9) << a;
    faces.insert(plan.Of(run)[1].text);
  }
  EXPECT_EQ(faces, (std::set<std::string>{"1", "2", "3", "4", "5", "6"}));
  // Another key beside it, or fewer runs, change nothing; another seed does.
  const Plan alone = Read("random: {" + friction + "}\nruns: 5");
  const Plan other = Read("random: {" + friction + "}\nruns: 5\nseed: 2");
  for (std::size_t run = 1; run <= 5; ++run) {
    EXPECT_EQ(alone.Of(run)[0], plan.Of(run)[0]);
    EXPECT_NE(alone.Of(run)[0], other.Of(run)[0]);
  }
}

TEST(PlanTest, EveryCombinationMeetsTheSameDraws) {
  const Plan plan = Read("grid: {robot: [go2, b2]}\nrandom: {a: {from: 0, to: 1}}\nruns: 3");
  ASSERT_EQ(plan.size(), 6U);
  for (std::size_t run = 1; run <= 3; ++run) {
    EXPECT_EQ(plan.Of(run)[1], plan.Of(run + 3)[1]);
    EXPECT_NE(plan.Of(run)[0], plan.Of(run + 3)[0]);
  }
}

TEST(PlanTest, SamplesHaveEachListedValueAndTheEndsOfRanges) {
  const Plan plan = Read("grid: {robot: [go2, b2]}\nlatin: {a: {from: 0, to: 1}}\nruns: 40");
  double least = 1, most = 0;
  std::set<std::string> robots;
  const std::vector<std::size_t> samples = plan.Samples();
  for (const std::size_t run : samples) {
    robots.insert(plan.Of(run)[0].text);
    least = std::min(least, std::stod(plan.Of(run)[1].text));
    most = std::max(most, std::stod(plan.Of(run)[1].text));
  }
  EXPECT_LE(samples.size(), 4U);
  EXPECT_EQ(robots.size(), 2U);
  EXPECT_LT(least, 1 / 40.);
  EXPECT_GT(most, 39 / 40.);
}

TEST(PlanTest, SaysWhereAndWhatIsWrongWithTheNearestWord) {
  const std::pair<std::string, const char*> kRows[] = {
      {"gird: {a: [1]}", "v:1: key 'vary.gird': unknown; did you mean 'grid'?"},
      {"[1]", "v:1: vary: expected a mapping"},
      {"seed: 1", "v:1: vary.seed: only beside random or latin"},
      {"random: {a: [1]}", "v:1: vary.runs: missing"},
      {"random: {a: [1]}\nruns: 0", "v:2: vary.runs: expected a whole number from 1"},
      {"random: {a: [1]}\nlatin: {b: [1]}\nruns: 1", "v:2: vary.latin: not beside random"},
      {"grid: {a: 1}", "v:1: a: expected a list of values, or a range"},
      {"grid: {a: []}", "v:1: a: expected a list of values"},
      {"grid: {a: [1, 2, 1]}", "v:1: a: 1 is there twice"},
      {"grid: {a: {from: 0, to: 1}}", "v:1: a.count: missing"},
      {"grid: {a: {from: 2, to: 1, count: 2}}", "v:1: a.to: is less than from"},
      {"grid: {a: {from: 2, too: 3}}", "did you mean 'to'?"},
      {"grid: {a: {from: 2}}", "v:1: a.to: missing"},
      {"grid: {a: {from: x, to: 1}}", "v:1: a.from: expected a number"},
      {"grid: {seed: {from: 0.5, to: 3}}", "v:1: seed: expected whole numbers"},
      {"random: {a: {from: 0, to: 1, count: 3}}\nruns: 2", "v:1: a.count: only in a grid"},
      {"grid: {a: [1]}\nlist: [{a: 2}]", "v:2: vary: a varies already at v:1"},
      {"list: [{a: 1}, {b: 2}]", "v:1: key 'b': unknown"},
      {"list: [{a: 1, c: 1}, {a: 2}]", "v:1: vary.list: c: missing"},
      {"grid: {$9: [1]}", "v:1: vary: expected a key, or $ and a name"},
      {"grid: {a: {from: 1, to: 2000, count: 2000}, b: {from: 1, to: 2000, count: 2000}}",
       "at most 1000000"},
  };
  for (const auto& [text, error] : kRows) {
    EXPECT_THAT(config::ErrorOf([&text = text] { Read(text); }), HasSubstr(error)) << text;
  }
}

class VariedScenarioTest : public testing::Test {
 protected:
  Scenario Load(const std::string& more, std::size_t run,
                const std::vector<std::string>& command = {}) const {
    const std::string text =
        "scenario: S\nrobot: go2\nduration: 1\nexpect: [{always: base.height > $least}]\n";
    return LoadScenario(folder_.Write("s.yaml", text + more), {.command = command, .run = run});
  }
  std::string ErrorIn(const std::string& more, std::size_t run = 1) const {
    return config::ErrorOf([&] { Load(more, run); });
  }

  test::TemporaryFolder folder_;
};

TEST_F(VariedScenarioTest, ARunHasItsValues) {
  const std::string vary =
      "settings: {gate: {timeout: 0.5}}\n"
      "script: [{at: 0.5, push: {body: base_link, force: [0, $force, 0], for: 0.1}}]\n"
      "vary: {list: [{robot: go2, terrain.friction: 0.4, $force: 60, $least: 0.1},\n"
      "              {robot: b2, terrain.friction: 0.7, $force: -5, $least: 0.2}]}\n";
  const Scenario first = Load(vary, 1), second = Load(vary, 2);
  EXPECT_EQ(first.config.robots[0].spec.name, "go2");
  EXPECT_EQ(second.config.robots[0].spec.name, "b2");
  EXPECT_EQ(first.config.terrain.friction, 0.4);
  EXPECT_EQ(second.config.terrain.friction, 0.7);
  EXPECT_EQ(second.config.robots[0].gate.timeout, 0.5);
  EXPECT_THAT(emulator::Describe(second.script.events[0].request), HasSubstr("-5"));
  EXPECT_EQ(second.expect.list[0].asks, "always base.height > 0.2");
  EXPECT_EQ(second.run, 2U);
  EXPECT_EQ(Load(vary, 0).settings, first.settings);
}

TEST_F(VariedScenarioTest, WordsOfTheProgramAndOfJsonVary) {
  const std::string vary = "vary: {list: [{$speed: 0.5, $least: 0.1, $mode: 'fast walk'}]}\n";
  const Scenario scenario =
      Load("program: {command: [walk, --speed=$speed, $mode, '{\"x\": $speed, \"y\": $other}']}\n" +
               vary,
           1);
  EXPECT_THAT(scenario.program->command,
              ElementsAre("walk", "--speed=0.5", "fast walk", "{\"x\": 0.5, \"y\": $other}"));
  EXPECT_THAT(Load(vary, 1, {"walk", "$speed", "$mode"}).program->command,
              ElementsAre("walk", "0.5", "fast walk"));
}

TEST_F(VariedScenarioTest, TheClockAndWhatAProgramThinksVary) {
  const std::string vary =
      "vary: {list: [{clock: simulated, program.think: 0.002, $least: 0.1},\n"
      "              {clock: real, program.think: 0, $least: 0.1}]}\n";
  const std::string program = "program: {command: [walk], limit: 3}\n";
  const Scenario first = Load(program + vary, 1), second = Load(program + vary, 2);
  EXPECT_TRUE(first.simulated_clock);
  EXPECT_EQ(first.program->think, 0.002);
  EXPECT_EQ(first.program->limit, 3);
  EXPECT_FALSE(second.simulated_clock);
  EXPECT_EQ(second.program->think, 0);
  EXPECT_EQ(Load(vary, 1, {"walk"}).program->think, 0.002);
}

TEST_F(VariedScenarioTest, ARunHasItsNumberAsSeedUnlessThereIsOne) {
  const std::string random = "settings: {randomization: {mass: [0.9, 1.1]}}\n";
  const std::string vary = "vary: {grid: {$least: [0.1, 0.2, 0.3]}}\n";
  EXPECT_EQ(Load(random + vary, 3).config.randomization.seed, 3);
  EXPECT_EQ(Load("seed: 7\n" + random + vary, 3).config.randomization.seed, 7);
  EXPECT_EQ(Load("settings: {randomization: {mass: [0.9, 1.1], seed: 8}}\n" + vary, 3)
                .config.randomization.seed,
            8);
  const std::string seeds = "vary: {grid: {$least: [0.1], seed: {from: 40, to: 60}}}\n";
  EXPECT_EQ(Load(random + seeds, 3).config.randomization.seed, 42);
}

TEST_F(VariedScenarioTest, SaysWhereAndWhatIsWrong) {
  EXPECT_THAT(ErrorIn("vary: {grid: {$leest: [1]}}"),
              HasSubstr("s.yaml:5: vary: $leest: nothing in the scenario says so; did you mean "
                        "'$least'?"));
  EXPECT_THAT(ErrorIn("vary:\n  grid:\n    $least: [0.1]\n    terrain.fricton: [1]\n"),
              HasSubstr("s.yaml:8: vary: key 'terrain.fricton': unknown; did you mean "
                        "'friction'?"));
  EXPECT_THAT(ErrorIn("vary: {grid: {$least: [0.1], terrain.friction: [9]}}"),
              HasSubstr("s.yaml:5: vary: terrain.friction"));
  EXPECT_THAT(ErrorIn("vary: {grid: {$least: [0.1], robot: [gp2]}}"), HasSubstr("s.yaml:5: robot"));
  EXPECT_THAT(ErrorIn("vary: {grid: {$least: [0.1, 0.2]}}", 3),
              HasSubstr("there is no run 3; they are numbered from 1 to 2"));
  EXPECT_THAT(ErrorIn("", 3), HasSubstr("vary: missing, so there is no run 3"));
}

TEST_F(VariedScenarioTest, WhatALaterRunHasIsCheckedBeforeTheFirst) {
  const auto file = folder_.Write(
      "s.yaml",
      "scenario: S\nrobot: go2\nduration: 1\nexpect: [{always: base.height > 0}]\n"
      "vary: {grid: {scene: [flat, rough], terrain.friction: {from: 1, to: 9, count: 30}}}\n");
  const auto varied = LoadVaried(file);
  ASSERT_TRUE(varied.has_value());
  EXPECT_EQ(varied->plan.size(), 60U);
  EXPECT_THAT(config::ErrorOf([&] { CheckRuns(file, varied->plan, {}); }),
              testing::AllOf(HasSubstr("s.yaml:5: vary: terrain.friction"),
                             HasSubstr("(run 30: scene=flat terrain.friction=9)")));
}

TEST_F(VariedScenarioTest, ARecordingIsJudgedByTheRunThatItIsOf) {
  const auto file = folder_.Write("s.yaml",
                                  "scenario: S\nrobot: go2\nduration: 1\n"
                                  "expect: [{always: base.height > $least}]\n"
                                  "vary: {grid: {$least: [0.1, 0.3], $of_the_program: [1]}}\n");
  EXPECT_EQ(LoadStandard(file, "", "", 2).expect.list[0].asks, "always base.height > 0.3");
}

}  // namespace
}  // namespace understudy::rehearse
