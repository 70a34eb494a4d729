#include "rehearse/scenario.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/rehearse/rehearse_fixture.h"
#include "tests/support/temporary_folder.h"

namespace understudy::rehearse {
namespace {

using testing::HasSubstr;

constexpr char kSmall[] =
    "scenario: Small\nrobot: go2\nduration: 1\nexpect: [{always: base.height > 0}]\n";

class ScenarioTest : public testing::Test {
 protected:
  Scenario Load(const std::string& text, const ScenarioOptions& options = {}) const {
    return LoadScenario(folder_.Write("s.yaml", text), options);
  }
  std::string ErrorIn(const std::string& text) const {
    return config::ErrorOf([&] { Load(text); });
  }

  test::TemporaryFolder folder_;
};

TEST_F(ScenarioTest, SetsWhatARunDoes) {
  const Scenario scenario = Load(std::string(kSmall) +
                                 "start: standing\nseed: 7\nscene: slopes\n"
                                 "settings: {gate: {timeout: 0.5}}\n"
                                 "faults: [{component: imu, fault: off, at: 3}]\n"
                                 "script: [{at: 0.5, reset: }]\n");
  EXPECT_EQ(scenario.config.robots[0].start.pose, "standing");
  EXPECT_EQ(scenario.config.randomization.seed, 7);
  EXPECT_EQ(scenario.config.scene, "slopes");
  EXPECT_EQ(scenario.config.robots[0].gate.timeout, 0.5);
  ASSERT_EQ(scenario.config.robots[0].faults.size(), 1U);
  EXPECT_EQ(scenario.config.robots[0].faults[0].at, 3);
  EXPECT_EQ(scenario.config.time.duration, 1);
  EXPECT_EQ(scenario.config.time.speed, 0);
  EXPECT_EQ(scenario.script.events.size(), 1U);
}

TEST_F(ScenarioTest, ChoosesARevisionOfTheRobot) {
  const std::string text =
      "scenario: S\nrobot: g1\nrevision: 6\nduration: 1\nexpect: [{always: base.height > 0}]\n";
  EXPECT_EQ(Load(text).config.robots[0].spec.revision, "6");
  EXPECT_THAT(ErrorIn("revision: 99\n" + std::string(kSmall)),
              HasSubstr("s.yaml:1: robot.revision"));
}

TEST_F(ScenarioTest, GoesAtTheSpeedOfAClockWithAProgram) {
  EXPECT_EQ(Load(std::string(kSmall) + "program: {command: ['true']}\n").config.time.speed, 1);
  EXPECT_EQ(Load(kSmall, {.command = {"true"}}).config.time.speed, 1);
}

TEST_F(ScenarioTest, TakesProgramAndSettingsOfTheCommandLine) {
  const Scenario scenario = Load(std::string(kSmall) + "program: {command: ['true'], at: 0.5}\n",
                                 {.command = {"false", "1"}, .sets = {"gate.timeout=0.25"}});
  EXPECT_EQ(scenario.program->command, (std::vector<std::string>{"false", "1"}));
  EXPECT_EQ(scenario.program->at, 0.5);
  EXPECT_EQ(scenario.config.robots[0].gate.timeout, 0.25);
}

TEST_F(ScenarioTest, FindsASceneBesideItself) {
  folder_.Write("ground.yaml", "scene: flat\n");
  const Scenario scenario = Load(std::string(kSmall) + "scene: ground.yaml\n");
  EXPECT_EQ(scenario.config.scene, "flat");
}

TEST_F(ScenarioTest, SaysWhereAndWhatIsWrongWithTheNearestWord) {
  const std::pair<std::string, const char*> kRows[] = {
      {"scenari: a\nexpect: []", "s.yaml:1: key 'scenari': unknown; did you mean 'scenario'?"},
      {"scenario: a\nexpect: []", "robot: missing"},
      {"- {at: 1, reset: }", "s.yaml:1: this is a script: understudy run ROBOT --script /"},
      {"script: [{at: 1, reset: }]", "s.yaml:1: this is a script: understudy run ROBOT --script /"},
      {"scenario: a\nrobot: gp2\nduration: 1\nexpect: []", "s.yaml:2: robot 'gp2'"},
      {"scenario: a\nrobot: go2\nduration: 1", "expect: missing"},
      {"scenario: a\nrobot: go2\nduration: 1\nexpect: []",
       "expect: expected a list of expectations"},
      {"scenario: a\nrobot: go2\nexpect: []", "duration: missing"},
      {std::string(kSmall) + "settings: {gate: {tiemout: 1}}", "s.yaml:5: key 'gate.tiemout'"},
      {std::string(kSmall) + "faults: [{component: imv, fault: off}]", "did you mean 'imu'?"},
      {std::string(kSmall) + "start: siting", "s.yaml:5: start.pose"},
      {std::string(kSmall) + "script: [{at: 1, resett: }]", "did you mean 'reset'?"},
      {std::string(kSmall) + "program: {comand: [a]}", "did you mean 'command'?"},
      {std::string(kSmall) + "program: {command: a}", "command: expected a list of words"},
      {std::string(kSmall) + "program: {command: [a], by: axe}",
       "s.yaml:5: program.by: expected one of term, kill, got 'axe'"},
      {std::string(kSmall) + "program: {command: [a], at: 2, until: 1}",
       "would end before it starts"},
  };
  for (const auto& [text, error] : kRows) EXPECT_THAT(ErrorIn(text), HasSubstr(error)) << text;
}

TEST_F(ScenarioTest, PlaysSeveralRobotsInOneWorldEachWithItsOwnKeys) {
  const std::string robots =
      "scenario: Two\nduration: 1\nstart: standing\n"
      "robots: {left: {robot: go2}, right: {robot: g1, start: {pose: hanging}, profile: ideal}}\n"
      "script: [{at: 0.5, robot: right, when: 'left:base.height > 0.2', crane.lower: 0.1}]\n";
  const Scenario scenario = Load(
      robots + "expect: [{always: 'left:base.tilt < 30 deg'}, {never: 'right:refused happens'}]\n");
  ASSERT_EQ(scenario.config.robots.size(), 2U);
  EXPECT_EQ(scenario.config.robots[0].start.pose, "standing");
  EXPECT_EQ(scenario.config.robots[1].start.pose, "hanging");
  EXPECT_EQ(scenario.config.robots[1].network.domain, 1);
  EXPECT_EQ(scenario.script.events[0].request.robot, 1U);
  EXPECT_EQ(scenario.expect.signals[1].robot, 1U);
  EXPECT_EQ(scenario.expect.robots, (std::vector<std::string>{"left", "right"}));
  const auto file = folder_.Write("e.yaml",
                                  "robots: {a: {robot: go2}, b: {robot: go2}}\n"
                                  "expect: [{always: 'b:torque(FR_calf) < 50'}]\n");
  EXPECT_EQ(LoadStandard(file, "", "").expect.signals[0].robot, 1U);

  EXPECT_THAT(ErrorIn(robots + "expect: [{always: base.tilt < 30 deg}]\n"),
              HasSubstr("s.yaml:6: always: 'base.tilt' is of which robot"));
  EXPECT_THAT(ErrorIn(robots + "robot: go2\nexpect: [{always: 'left:base.x < 3'}]\n"),
              HasSubstr("robots: not beside robot"));
  EXPECT_THAT(ErrorIn(robots + "stages: [{name: a, torque: 1}]\n"
                               "expect: [{always: 'left:base.x < 3'}]\n"),
              HasSubstr("stages: only in a scenario of one robot"));
}

TEST_F(ScenarioTest, ItsExpectationsAloneNeedARobotFromSomewhere) {
  const auto file = folder_.Write("e.yaml", "expect: [{always: torque(FR_calf) < 50}]\n");
  EXPECT_EQ(LoadStandard(file, "go2", "").expect.list.size(), 1U);
  EXPECT_THAT(config::ErrorOf([&] { LoadStandard(file, "", ""); }), HasSubstr("robot: missing"));
  EXPECT_THAT(config::ErrorOf([&] { LoadStandard(file, "g1", "29"); }), HasSubstr("revision"));
}

TEST_F(ScenarioTest, GivesAProgramThatNothingElseEndsALimit) {
  const auto asks = [](const std::string& seconds) {
    return "eventually program_end happens, within " + seconds + " s, from program_start happens";
  };
  const std::string program =
      "scenario: P\nrobot: go2\nexpect: [{always: base.height > 0}]\nprogram: {command: [a]";
  const Scenario usual = Load(program + "}\n");
  ASSERT_EQ(usual.expect.list.size(), 2U);
  EXPECT_EQ(usual.expect.list[1].name, "the program ends within 600 s");
  EXPECT_EQ(usual.expect.list[1].asks, asks("600"));
  EXPECT_EQ(usual.program->limit, 600);
  EXPECT_EQ(Load(program + ", limit: 7.5}\n").expect.list[1].asks, asks("7.5"));
  EXPECT_EQ(Load(program + ", until: 3}\n").expect.list.size(), 1U);
  EXPECT_EQ(Load(program + "}\nduration: 3\n").expect.list.size(), 1U);
  EXPECT_EQ(Load(program + ", limit: 2}\nduration: 3\n").expect.list.size(), 2U);
  EXPECT_THAT(ErrorIn(program + ", limit: -1}\n"), HasSubstr("program.limit"));
}

TEST_F(ScenarioTest, JudgesARecordingByTheLimitToo) {
  const char* const kRows[] = {"program: {limit: 7}\n", "program: {command: [a], limit: 7}\n"};
  const std::string rest = "scenario: P\nrobot: go2\nexpect: [{always: base.height > 0}]\n";
  for (const char* program : kRows) {
    const auto file = folder_.Write("p.yaml", rest + program);
    EXPECT_EQ(LoadStandard(file, "", "").expect.list.back().name, "the program ends within 7 s");
  }
  // Its program was named on the command line.
  EXPECT_EQ(LoadStandard(folder_.Write("p.yaml", rest), "", "").expect.list.size(), 2U);
  EXPECT_EQ(LoadStandard(folder_.Write("p.yaml", kSmall), "", "").expect.list.size(), 1U);
}

TEST(ReferenceTest, IsThatOfTheDocument) {
  std::ifstream stream(std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / "docs" / "reference" /
                       "scenarios.md");
  const std::string document{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(document, HasSubstr(ScenarioReference()));
  EXPECT_THAT(document, HasSubstr(ExpectationsReference()));
  EXPECT_THAT(document, HasSubstr(signals::SignalsReference()));
}

TEST(ShippedScenariosTest, AreAllSound) {
  int seen = 0;
  const auto folder = std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / "config" / "scenarios";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_EQ(config::ErrorOf([&] { LoadScenario(entry.path()); }), "") << entry.path();
    ++seen;
  }
  EXPECT_GT(seen, 5);
}

}  // namespace
}  // namespace understudy::rehearse
