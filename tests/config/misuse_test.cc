// What a user can get wrong in a file or on the command line, one by one.
#include <clocale>

#include "config_fixture.h"

namespace understudy::config {
namespace {

class ConfigMisuseTest : public ConfigFixture {};

TEST_F(ConfigMisuseTest, NamesAnUnknownKeyAndTheNearestOne) {
  EXPECT_EQ(FileError("time:\n  speed: 1\ngate:\n  timout: 1\n"),
            "run.yaml:4: key 'gate.timout': unknown; did you mean 'timeout'? "
            "(valid: mode, timeout, damping_kd)");
}

TEST_F(ConfigMisuseTest, NamesAnUnknownSection) {
  EXPECT_EQ(FileError("gait: lenient\n"),
            "run.yaml:1: key 'gait': unknown; did you mean 'gate'? (valid: scene, terrain, "
            "network, guard, control, time, physics, sensors, gate, "
            "motion, crane, start, randomization, robot)");
}

TEST_F(ConfigMisuseTest, NamesAnUnknownKeyOfAListElement) {
  EXPECT_EQ(FileError("robot:\n  feet:\n    - {name: a, geom: [x]}\n"),
            "run.yaml:3: key 'robot.feet.0.geom': unknown; did you mean 'geoms'? "
            "(valid: name, geoms, axis)");
}

TEST_F(ConfigMisuseTest, RefusesTextForANumber) {
  EXPECT_EQ(FileError("gate:\n  timeout: fast\n"),
            "run.yaml:2: gate.timeout: expected a number from 0.001 to 3600 s, got 'fast'");
}

TEST_F(ConfigMisuseTest, RefusesAQuotedNumber) {
  EXPECT_EQ(FileError("gate: {timeout: '1'}\n"),
            "run.yaml:1: gate.timeout: expected a number from 0.001 to 3600 s, got the quoted text "
            "'1'");
}

TEST_F(ConfigMisuseTest, RefusesANumberThatIsNotWhole) {
  for (const char* text : {"1.5", "1e2", "0x10", "99999999999", "true", "1 2"}) {
    EXPECT_EQ(FileError(std::string("network: {domain: ") + text + "}\n"),
              std::string("run.yaml:1: network.domain: expected a whole number from 0 to 232, "
                          "got '") +
                  text + "'");
  }
}

TEST_F(ConfigMisuseTest, RefusesANumberThatIsNoWholeToken) {
  for (const char* text : {"1,5", "1.5s", "1e", "--1", "+-1", "+", ".", "1_0"}) {
    EXPECT_NE(FileError(std::string("gate:\n  timeout: ") + text + "\n"), "") << text;
  }
}

TEST_F(ConfigMisuseTest, ReadsNumbersInAnyCommonForm) {
  for (const char* text : {"0.5", ".5", "5e-1", "+0.5", "0.50"}) {
    EXPECT_EQ(LoadText(std::string("gate:\n  timeout: ") + text + "\n").gate.timeout, 0.5) << text;
  }
}

TEST_F(ConfigMisuseTest, ReadsNumbersWhateverTheLocale) {
  const char* set = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // a decimal comma, where installed
  EXPECT_EQ(LoadText("gate: {timeout: 0.5}\n").gate.timeout, 0.5);
  EXPECT_NE(FileError("gate:\n  timeout: 0,5\n"), "");
  if (set != nullptr) std::setlocale(LC_NUMERIC, "C");
}

TEST_F(ConfigMisuseTest, RefusesANumberOutOfRange) {
  EXPECT_EQ(FileError("network: {domain: 233}\n"),
            "run.yaml:1: network.domain: expected a whole number from 0 to 232, got '233'");
  EXPECT_EQ(FileError("time: {duration: -1}\n"),
            "run.yaml:1: time.duration: expected a number of at least 0 s, got '-1'");
}

TEST_F(ConfigMisuseTest, RefusesANumberThatIsNotFinite) {
  for (const char* text : {".nan", "nan", ".inf", "inf", "infinity", "1e999"}) {
    EXPECT_EQ(FileError(std::string("time: {duration: ") + text + "}\n"),
              std::string("run.yaml:1: time.duration: expected a number of at least 0 s, got '") +
                  text + "'");
  }
}

TEST_F(ConfigMisuseTest, RefusesYesForTrue) {
  EXPECT_EQ(FileError("sensors: {noise: yes}\n"),
            "run.yaml:1: sensors.noise: expected true or false, got 'yes'");
}

TEST_F(ConfigMisuseTest, RefusesAWordThatIsNoneOfTheChoice) {
  EXPECT_EQ(FileError("gate: {mode: linient}\n"),
            "run.yaml:1: gate.mode: expected one of strict, lenient, got 'linient'; did you mean "
            "'lenient'?");
  EXPECT_EQ(FileError("gate: loose\n"),
            "run.yaml:1: gate.mode: expected one of strict, lenient, got 'loose'");
  EXPECT_EQ(FileError("start: {pose: siting}\n"),
            "run.yaml:1: start.pose: expected one of \"\", lying, standing, hanging, clamped, got "
            "'siting'; did you mean 'standing'?");
}

TEST_F(ConfigMisuseTest, RefusesNothingForAValue) {
  EXPECT_EQ(FileError("gate:\n  timeout:\n"),
            "run.yaml:2: gate.timeout: expected a number from 0.001 to 3600 s, got nothing");
  EXPECT_EQ(FileError("scene:\n"), "run.yaml:1: scene: expected one line of text, got nothing");
}

TEST_F(ConfigMisuseTest, RefusesTextOfTwoLines) {
  EXPECT_EQ(FileError("scene: \"flat\\nhilly\"\n"),
            "run.yaml:1: scene: expected one line of text, got the quoted text 'flat.hilly'");
}

TEST_F(ConfigMisuseTest, RefusesAListForAValue) {
  EXPECT_EQ(FileError("gate: {timeout: [1]}\n"),
            "run.yaml:1: gate.timeout: expected a number from 0.001 to 3600 s, got a list");
}

TEST_F(ConfigMisuseTest, RefusesAValueForASection) {
  EXPECT_EQ(FileError("time: 2\n"), "run.yaml:1: time: expected a mapping of keys, got '2'");
  EXPECT_EQ(FileError("gate: [strict]\n"),
            "run.yaml:1: gate: expected a mapping of keys, got a list");
}

TEST_F(ConfigMisuseTest, RefusesAListForAWholeFile) {
  EXPECT_EQ(FileError("- gate\n"), "run.yaml:1: expected keys and values, got a list");
}

TEST_F(ConfigMisuseTest, RefusesAValueForAList) {
  EXPECT_EQ(FileError("robot: {motors: 12}\n"),
            "run.yaml:1: robot.motors: expected a list of mappings, got '12'");
  EXPECT_EQ(FileError("robot: {feet: [{name: a, geoms: x}]}\n"),
            "run.yaml:1: robot.feet.0.geoms: expected a list of words, got 'x'");
  EXPECT_EQ(FileError("robot: {lying: {q: 1}}\n"),
            "run.yaml:1: robot.lying.q: expected a list of numbers from -10 to 10 rad, got '1'");
}

TEST_F(ConfigMisuseTest, RefusesAListElementOfTheWrongType) {
  EXPECT_EQ(FileError("robot: {lying: {q: [0, x]}}\n"),
            "run.yaml:1: robot.lying.q.1: expected a number from -10 to 10 rad, got 'x'");
  EXPECT_EQ(FileError("robot: {motors: [3]}\n"),
            "run.yaml:1: robot.motors.0: expected a mapping of keys, got '3'");
}

TEST_F(ConfigMisuseTest, RefusesTheWrongNumberOfNumbers) {
  EXPECT_EQ(FileError("robot: {crane_point: [0, 0]}\n"),
            "run.yaml:1: robot.crane_point: expected 3 numbers, got 2");
}

TEST_F(ConfigMisuseTest, RefusesAKeyGivenTwice) {
  EXPECT_EQ(FileError("gate: strict\ntime: {speed: 1}\ngate: lenient\n"),
            "run.yaml:3: key 'gate' is given twice, first at run.yaml:1");
}

TEST_F(ConfigMisuseTest, RefusesAnUnknownRobot) {
  EXPECT_EQ(ErrorOf([&] { LoadConfig({.robot = "tinny"}, directory_); }),
            "robot 'tinny': unknown; did you mean 'tiny'? (valid: tiny)");
  EXPECT_EQ(ErrorOf([&] { LoadConfig({}, directory_); }), "robot '': unknown; valid: tiny");
}

TEST_F(ConfigMisuseTest, RefusesAMissingConfigFile) {
  EXPECT_EQ(ErrorOf([&] { Load({"/nowhere/run.yaml"}); }),
            "/nowhere/run.yaml: cannot be read: No such file or directory");
}

TEST_F(ConfigMisuseTest, RefusesASetWithoutKeyOrValue) {
  for (const std::string set : {"", "gate", "=1", ".gate=1", "gate.=1", "a..b=1"}) {
    EXPECT_EQ(SetError(set), "--set " + set + ": expected KEY=VALUE, as in gate.timeout=0.5");
  }
  EXPECT_NE(SetError(std::string(100000, '.') + "=1"), "");
}

TEST_F(ConfigMisuseTest, NamesTheSetThatIsWrong) {
  EXPECT_EQ(SetError("gate.timout=1"),
            "--set gate.timout=1: key 'gate.timout': unknown; did you mean 'timeout'? "
            "(valid: mode, timeout, damping_kd)");
  EXPECT_EQ(SetError("gate.timeout="),
            "--set gate.timeout=: gate.timeout: expected a number from 0.001 to 3600 s, got "
            "nothing");
  EXPECT_THAT(SetError("robot.lying.q=[1"), testing::StartsWith("--set robot.lying.q=[1: not"));
}

TEST_F(ConfigMisuseTest, RefusesAnElementThatIsNotThere) {
  EXPECT_EQ(SetError("robot.motors.2.slot=1"),
            "--set robot.motors.2.slot=1: robot.motors: has 2 elements, counted from 0; there is "
            "no '2'");
  EXPECT_EQ(SetError("robot.lying.q.x=1"),
            "--set robot.lying.q.x=1: robot.lying.q: has 2 elements, counted from 0; there is no "
            "'x'");
}

}  // namespace
}  // namespace understudy::config
