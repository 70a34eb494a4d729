// Tests the errors for wrong files and command lines.
#include <clocale>

#include "config_fixture.h"

namespace understudy::config {
namespace {

class ConfigMisuseTest : public ConfigFixture {};

TEST_F(ConfigMisuseTest, OfAFileIsToldWithItsLineItsKeyAndWhatWasExpected) {
  const std::pair<const char*, const char*> rows[] = {
      {"time:\n  speed: 1\ngate:\n  timout: 1\n",
       "run.yaml:4: key 'gate.timout': unknown; did you mean 'timeout'? "
       "(valid: mode, timeout, damping_kd)"},
      {"gait: lenient\n",
       "run.yaml:1: key 'gait': unknown; did you mean 'gate'? (valid: profile, look, scene, "
       "terrain, objects, network, guard, control, time, recording, physics, sensors, gate, "
       "motion, crane, start, faults, randomization, robot)"},
      {"robot:\n  feet:\n    - {name: a, geom: [x]}\n",
       "run.yaml:3: key 'robot.feet.0.geom': unknown; did you mean 'geoms'? "
       "(valid: name, geoms, axis)"},
      {"gate:\n  timeout: fast\n",
       "run.yaml:2: gate.timeout: expected a number from 0.001 to 3600 s, got 'fast'"},
      {"gate: {timeout: '1'}\n",
       "run.yaml:1: gate.timeout: expected a number from 0.001 to 3600 s, got the quoted text "
       "'1'"},
      {"network: {domain: 233}\n",
       "run.yaml:1: network.domain: expected a whole number from 0 to 232, got '233'"},
      {"time: {duration: -1}\n",
       "run.yaml:1: time.duration: expected a number of at least 0 s, got '-1'"},
      {"sensors: {noise: yes}\n", "run.yaml:1: sensors.noise: expected true or false, got 'yes'"},
      {"gate: {mode: linient}\n",
       "run.yaml:1: gate.mode: expected one of strict, lenient, got 'linient'; did you mean "
       "'lenient'?"},
      {"gate: loose\n", "run.yaml:1: gate.mode: expected one of strict, lenient, got 'loose'"},
      {"start: {pose: siting}\n",
       "run.yaml:1: start.pose: expected one of lying, standing, hanging, clamped, got "
       "'siting'; did you mean 'standing'?"},
      {"gate:\n  timeout:\n",
       "run.yaml:2: gate.timeout: expected a number from 0.001 to 3600 s, got nothing"},
      {"scene:\n", "run.yaml:1: scene: expected one line of text, got nothing"},
      {"scene: \"flat\\nhilly\"\n",
       "run.yaml:1: scene: expected one line of text, got the quoted text 'flat.hilly'"},
      {"gate: {timeout: [1]}\n",
       "run.yaml:1: gate.timeout: expected a number from 0.001 to 3600 s, got a list"},
      {"time: 2\n", "run.yaml:1: time: expected a mapping of keys, got '2'"},
      {"gate: [strict]\n", "run.yaml:1: gate: expected a mapping of keys, got a list"},
      {"- gate\n", "run.yaml:1: expected keys and values, got a list"},
      {"robot: {motors: 12}\n", "run.yaml:1: robot.motors: expected a list of mappings, got '12'"},
      {"robot: {feet: [{name: a, geoms: x}]}\n",
       "run.yaml:1: robot.feet.0.geoms: expected a list of words, got 'x'"},
      {"robot: {lying: {q: 1}}\n",
       "run.yaml:1: robot.lying.q: expected a list of numbers from -10 to 10 rad, got '1'"},
      {"robot: {lying: {q: [0, x]}}\n",
       "run.yaml:1: robot.lying.q.1: expected a number from -10 to 10 rad, got 'x'"},
      {"robot: {motors: [3]}\n", "run.yaml:1: robot.motors.0: expected a mapping of keys, got '3'"},
      {"robot: {crane_point: [0, 0]}\n",
       "run.yaml:1: robot.crane_point: expected 3 numbers, got 2"},
      {"gate: strict\ntime: {speed: 1}\ngate: lenient\n",
       "run.yaml:3: key 'gate' is given twice, first at run.yaml:1"},
  };
  for (const auto& [text, error] : rows) EXPECT_EQ(FileError(text), error);
}

TEST_F(ConfigMisuseTest, OfASetIsToldWithItsKeyAndWhatWasExpected) {
  const std::pair<const char*, const char*> rows[] = {
      {"gate.timout=1",
       "--set gate.timout=1: key 'gate.timout': unknown; did you mean 'timeout'? "
       "(valid: mode, timeout, damping_kd)"},
      {"gate.timeout=",
       "--set gate.timeout=: gate.timeout: expected a number from 0.001 to 3600 s, got "
       "nothing"},
      {"robot.motors.2.slot=1",
       "--set robot.motors.2.slot=1: robot.motors: has 2 elements, counted from 0; there is "
       "no '2'"},
      {"robot.lying.q.x=1",
       "--set robot.lying.q.x=1: robot.lying.q: has 2 elements, counted from 0; there is no "
       "'x'"},
  };
  for (const auto& [set, error] : rows) EXPECT_EQ(SetError(set), error);
  EXPECT_THAT(SetError("robot.lying.q=[1"), testing::StartsWith("--set robot.lying.q=[1: not"));
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
    EXPECT_EQ(LoadText(std::string("gate:\n  timeout: ") + text + "\n").robots[0].gate.timeout, 0.5)
        << text;
  }
}

TEST_F(ConfigMisuseTest, ReadsNumbersWhateverTheLocale) {
  const char* set = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // a decimal comma, where installed
  EXPECT_EQ(LoadText("gate: {timeout: 0.5}\n").robots[0].gate.timeout, 0.5);
  EXPECT_NE(FileError("gate:\n  timeout: 0,5\n"), "");
  if (set != nullptr) std::setlocale(LC_NUMERIC, "C");
}

TEST_F(ConfigMisuseTest, RefusesANumberThatIsNotFinite) {
  for (const char* text : {".nan", "nan", ".inf", "inf", "infinity", "1e999"}) {
    EXPECT_EQ(FileError(std::string("time: {duration: ") + text + "}\n"),
              std::string("run.yaml:1: time.duration: expected a number of at least 0 s, got '") +
                  text + "'");
  }
}

TEST_F(ConfigMisuseTest, RefusesAnUnknownRobot) {
  EXPECT_EQ(ErrorOf([&] { LoadConfig({.robot = "tinny"}, directory_); }),
            "robot 'tinny': unknown; did you mean 'tiny'? (valid: tiny)");
  EXPECT_EQ(ErrorOf([&] { LoadConfig({.robot = "unitree_tiny"}, directory_); }),
            "robot 'unitree_tiny': unknown; did you mean 'tiny'? (valid: tiny)");
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

}  // namespace
}  // namespace understudy::config
