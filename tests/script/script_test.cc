#include "script/script.h"

#include <cmath>

#include "tests/config/config_fixture.h"

namespace understudy::script {
namespace {

Script ReadAll(const std::string& text) {
  return ReadScript(schema::ParseYaml(text, "s"), signals::RunningNames());
}
std::vector<emulator::ScriptEvent> Read(const std::string& text) { return ReadAll(text).events; }
std::string ErrorIn(const std::string& event) {
  return config::ErrorOf([&] { Read("script:\n  - " + event + "\n"); });
}
std::string One(const std::string& event) {
  return emulator::Describe(Read("script: [" + event + "]").front().request);
}

TEST(ScriptTest, SaysOfAScenarioHowItIsPlayed) {
  for (const char* text :
       {"scenario: x\nrobot: go2\nexpect: [safe]\n", "scenario: x\nscript: [{at: 1, reset: }]\n"}) {
    EXPECT_THAT(config::ErrorOf([&] { Read(text); }),
                testing::EndsWith("this is a scenario: understudy rehearse s"));
  }
}

TEST(ScriptTest, ReadsEvents) {
  EXPECT_EQ(One("{at: 1, remote.press: L2+B}"), "remote.press L2+B");
  EXPECT_EQ(One("{at: 1, remote.press: {keys: A, for: 2}}"), "remote.press A for 2 s");
  EXPECT_EQ(One("{at: 1, remote.hold: L2}"), "remote.hold L2");
  EXPECT_EQ(One("{at: 1, remote.sticks: {ly: 0.5, for: 2}}"), "remote.sticks ly 0.5 for 2 s");
  EXPECT_EQ(One("{at: 1, remote.off: }"), "remote.off");
  EXPECT_EQ(One("{at: 1, crane.attach: {}}"), "crane.attach");
  EXPECT_EQ(One("{at: 1, crane.raise: 0.2}"), "crane.raise 0.2 m");
  EXPECT_EQ(One("{at: 1, crane.lower: {by: 0.2}}"), "crane.lower 0.2 m");
  EXPECT_EQ(One("{at: 1, clamp: on}"), "clamp on");
  EXPECT_EQ(One("{at: 1, clamp: false}"), "clamp off");
  EXPECT_EQ(One("{at: 1, reset: }"), "reset");
  EXPECT_EQ(One("{at: 1, reset: standing}"), "reset standing");
  EXPECT_EQ(One("{at: 1, speed: 0.5}"), "speed 0.5 s/s");
  EXPECT_EQ(One("{at: 1, speed: max}"), "speed max");
  EXPECT_EQ(One("{at: 1, push: {body: trunk, force: [1, 2, -3], for: 0.2}}"),
            "push trunk 1 2 -3 N for 0.2 s");
  EXPECT_EQ(One("{at: 1, push: {impulse: [0, 5, 0]}}"), "push impulse 0 5 0 N·s");
  EXPECT_EQ(One("{at: 1, pause: }"), "pause");
  EXPECT_EQ(One("{at: 1, drag: {body: trunk, to: [1, 2, 3]}}"), "drag trunk 1 2 3 m");
}

TEST(ScriptTest, SortsByTimeAndKeepsTheOrderOfEqualTimes) {
  const auto events = Read(
      "script:\n- {at: 2, remote.hold: A}\n- {at: 1, remote.hold: B}\n- {at: 2, remote.hold: X}\n");
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].at, 1);
  EXPECT_EQ(events[0].where, "s:3");
  EXPECT_EQ(events[1].request.number("keys"), 0x100);
  EXPECT_EQ(events[2].request.number("keys"), 0x400);
}

TEST(ScriptTest, SaysWhereAndWhatIsWrong) {
  EXPECT_EQ(
      ErrorIn("{reset: }"),
      "s:2: at: missing; expected the time of the event in seconds, or when, or after: previous");
  EXPECT_EQ(ErrorIn("{at: soon, reset: }"), "s:2: at: expected seconds, got 'soon'");
  EXPECT_EQ(ErrorIn("{at: -1, reset: }"), "s:2: at: expected seconds, got '-1'");
  EXPECT_EQ(ErrorIn("{at: 1}"), "s:2: what is to happen at 1?");
  EXPECT_EQ(ErrorIn("{at: 1, remote.press: L3}"),
            "s:2: remote.press: keys: expected keys of the remote controller, as in L2+B, got "
            "\"L3\"");
  EXPECT_EQ(ErrorIn("{at: 1, remote.press: A, remote.hold: B}"),
            "s:2: one event cannot be both remote.press and remote.hold");
  EXPECT_THAT(ErrorIn("{at: 1, remote.hold: {keys: A, for: 1}}"),
              testing::StartsWith("s:2: remote.hold: unknown key \"for\""));
  EXPECT_EQ(ErrorIn("{at: 1, push: {force: [1, 2], for: 1}}"),
            "s:2: push: force: expected three numbers from -1000000 to 1000000 N, got an array");
  EXPECT_EQ(ErrorIn("{at: 1, crane.lower: far}"),
            "s:2: crane.lower: by: expected a number from -10 to 10 m, got \"far\"");
  EXPECT_EQ(ErrorIn("{at: 1, crane.lower: '1'}"),
            "s:2: crane.lower: by: expected a number from -10 to 10 m, got \"1\"");
  EXPECT_EQ(ErrorIn("{at: 1, clamp: maybe}"),
            "s:2: clamp: on: expected true or false, got \"maybe\"");
  EXPECT_EQ(ErrorIn("5"),
            "s:2: script: expected an event, as in {at: 1.5, remote.press: L2+B}, got '5'");
}

TEST(ScriptTest, ReadsWhatAnEventWaitsFor) {
  const Script script = ReadAll(
      "script:\n"
      "- {when: lowcmd arrives, crane.lower: 0.3}\n"
      "- {after: previous, at: 0.5, when: base.height < 0.8 and feet.force > 20, within: 10,\n"
      "   crane.release: }\n"
      "- {after: previous, at: 2, reset: }\n");
  ASSERT_EQ(script.events.size(), 3U);
  const emulator::ScriptEvent &first = script.events[0], &second = script.events[1],
                              &third = script.events[2];
  EXPECT_EQ(first.at, 0);
  EXPECT_FALSE(first.after);
  EXPECT_EQ(first.when, 0U);
  EXPECT_EQ(first.condition, "lowcmd arrives");
  EXPECT_TRUE(std::isinf(first.within));
  EXPECT_TRUE(second.after);
  EXPECT_EQ(second.at, 0.5);
  EXPECT_EQ(second.when, 1U);
  EXPECT_EQ(second.within, 10);
  EXPECT_TRUE(third.after);
  EXPECT_FALSE(third.when);
  EXPECT_EQ(script.conditions.formulas.size(), 2U);
  EXPECT_EQ(script.conditions.signals.size(), 3U);
}

TEST(ScriptTest, SortsSequencesAndLeavesThemTogether) {
  const auto events = Read(
      "script:\n"
      "- {at: 2, remote.hold: A}\n"
      "- {after: previous, remote.hold: B}\n"
      "- {at: 1, remote.hold: X}\n"
      "- {after: previous, at: 9, remote.hold: Y}\n"
      "- {when: lowcmd arrives, reset: }\n");
  std::vector<std::string> where;
  for (const emulator::ScriptEvent& event : events) where.push_back(event.where);
  EXPECT_THAT(where, testing::ElementsAre("s:6", "s:4", "s:5", "s:2", "s:3"));
}

TEST(ScriptTest, SaysWhatIsWrongWithAWait) {
  const std::pair<const char*, const char*> kRows[] = {
      {"{when: base.hight < 1, reset: }",
       "s:2: when: no signal 'base.hight'; did you mean 'base.height'?"},
      {"{when: lowcmt arrives, reset: }", "did you mean 'rt/lowcmd'?"},
      {"{when: base.height <, reset: }", "s:2: when: expected a number after '<', got the end"},
      {"{when: [a], reset: }", "s:2: when: expected a condition, as in lowcmd arrives, got a list"},
      {"{when: lowcmd arrives}", "s:2: what is to happen?"},
      {"{wen: lowcmd arrives, reset: }", "s:2: unknown key 'wen'; did you mean 'when'?"},
      {"{at: 1, within: 2, reset: }", "s:2: within: only beside when"},
      {"{when: lowcmd arrives, within: soon, reset: }",
       "s:2: within: expected seconds, got 'soon'"},
      {"{after: previous, reset: }", "s:2: after: no event comes before this one"},
      {"{after: 3, reset: }", "s:2: after: expected previous, got '3'"},
  };
  for (const auto& [event, error] : kRows) {
    EXPECT_THAT(ErrorIn(event), testing::HasSubstr(error)) << event;
  }
}

TEST(ScriptTest, BoundsHowOftenItWaits) {
  std::string text = "script:\n";
  for (int i = 0; i < 257; ++i) text += "- {when: lowcmd arrives, reset: }\n";
  EXPECT_EQ(config::ErrorOf([&] { Read(text); }), "s:258: when: a script waits at most 256 times");
}

TEST(ScriptTest, SaysOnWhichLineTheWrongValueOfARequestStands) {
  const auto error_in = [](const std::string& push) {
    return config::ErrorOf([&] { Read("script:\n- at: 1\n  push:\n" + push); });
  };
  EXPECT_EQ(error_in("    force: [1, 2, 3]\n    for: 0\n"),
            "s:5: push: for: expected a number from 0.0001 to 1000000 s, got 0");
  EXPECT_THAT(error_in("    for: 1\n    force:\n    - 1\n    - 2\n"),
              testing::StartsWith("s:5: push: force: expected three numbers"));
  EXPECT_THAT(error_in("    for: 1\n    forse: [1, 2, 3]\n"),
              testing::StartsWith("s:5: push: unknown key \"forse\""));
  EXPECT_THAT(error_in("    for: 1\n"), testing::StartsWith("s:3: push: expected either force"));
}

TEST(ScriptTest, NamesTheNearestOfAnUnknownKey) {
  EXPECT_THAT(ErrorIn("{at: 1, remote.pres: A}"),
              testing::StartsWith("s:2: unknown key 'remote.pres'; did you mean 'remote.press'?"));
  EXPECT_THAT(config::ErrorOf([] { Read("script: []\nrobot: {}\n"); }),
              testing::StartsWith("s:2: unknown key 'robot'"));
}

TEST(ScriptTest, NamesTheRequestOfWhichAKeyIsAPart) {
  const std::pair<const char*, const char*> kRows[] = {
      {"{at: 1, press: L2+B}", "s:2: unknown key 'press'; did you mean 'remote.press'?"},
      {"{at: 1, sticks: {ly: 1}}", "s:2: unknown key 'sticks'; did you mean 'remote.sticks'?"},
      {"{at: 1, crane: {lower: 0.1}}", "s:2: unknown key 'crane'; did you mean 'crane.lower'?"},
      {"{at: 1, crane: attach}", "s:2: unknown key 'crane'; did you mean 'crane.attach'?"},
      {"{at: 1, remote: on}", "s:2: unknown key 'remote'; did you mean 'remote.on'?"},
      {"{at: 1, release: A}",
       "s:2: unknown key 'release'; did you mean 'crane.release' or 'remote.release'?"},
  };
  for (const auto& [event, error] : kRows) EXPECT_EQ(ErrorIn(event), error);
}

TEST(ScriptTest, DoesNotResumeForAPausedRunPlaysNoScript) {
  EXPECT_THAT(ErrorIn("{at: 1, resume: }"), testing::StartsWith("s:2: unknown key 'resume'"));
}

TEST(ScriptTest, IsKnownByItsKey) {
  EXPECT_TRUE(IsScript(schema::ParseYaml("script: []", "s")));
  EXPECT_FALSE(IsScript(schema::ParseYaml("robot: {}", "s")));
  EXPECT_FALSE(IsScript(schema::ParseYaml("[1]", "s")));
}

signals::Names Two() {
  signals::Names go2{.joints = {"hip"}, .slots = {0}, .torque_limits = {1}};
  signals::Names g1{.joints = {"waist"}, .slots = {0}, .torque_limits = {1}};
  go2.robot = "go2";
  g1.robot = "g1";
  g1.number = 1;
  go2.others = {g1};
  return go2;
}

TEST(ScriptTest, OfSeveralRobotsEachEventNamesItsOwn) {
  const auto read = [](const std::string& text) {
    return ReadEvents(schema::ParseYaml(text, "s"), Two());
  };
  const Script script = read(
      "[{at: 1, robot: g1, when: base.height < 1, push: {force: [1, 0, 0]}},\n"
      " {at: 2, robot: go2, when: 'g1:torque(waist) > 1 and torque(hip) > 1', clamp: on},\n"
      " {at: 3, pause: }]");
  EXPECT_EQ(script.events[0].request.robot, 1U);
  EXPECT_EQ(script.events[1].request.robot, 0U);
  EXPECT_EQ(script.events[2].request.robot, 0U);
  ASSERT_EQ(script.conditions.signals.size(), 3U);
  EXPECT_EQ(script.conditions.signals[0].robot, 1U);
  EXPECT_EQ(script.conditions.signals[1].name, "g1:torque(waist)");
  EXPECT_EQ(script.conditions.signals[1].robot, 1U);
  EXPECT_EQ(script.conditions.signals[2].robot, 0U);
  EXPECT_THAT([&] { read("[{at: 1, clamp: on}]"); },
              testing::ThrowsMessage<ConfigError>(
                  testing::HasSubstr("robot: missing; expected one of go2, g1")));
  EXPECT_THAT([&] { read("[{at: 1, robot: g2, clamp: on}]"); },
              testing::ThrowsMessage<ConfigError>(testing::HasSubstr("no robot 'g2'")));
  EXPECT_THAT([&] { read("[{at: 1, robot: g1, when: torque(hip) > 1, clamp: on}]"); },
              testing::ThrowsMessage<ConfigError>(testing::HasSubstr("no joint 'hip'")));
}

}  // namespace
}  // namespace understudy::script
