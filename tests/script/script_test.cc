#include "script/script.h"

#include "tests/config/config_fixture.h"

namespace understudy::script {
namespace {

std::vector<emulator::ScriptEvent> Read(const std::string& text) {
  return ReadScript(config::ParseYaml(text, "s"));
}
std::string ErrorIn(const std::string& event) {
  return config::ErrorOf([&] { Read("script:\n  - " + event + "\n"); });
}
std::string One(const std::string& event) {
  return emulator::Describe(Read("script: [" + event + "]").front().request);
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
  EXPECT_EQ(One("{at: 1, speed: max}"), "speed 0 s/s");
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
  EXPECT_EQ(ErrorIn("{reset: }"), "s:2: at: missing; expected the time of the event in seconds");
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

TEST(ScriptTest, DoesNotResumeForAPausedRunPlaysNoScript) {
  EXPECT_THAT(ErrorIn("{at: 1, resume: }"), testing::StartsWith("s:2: unknown key 'resume'"));
}

TEST(ScriptTest, IsKnownByItsKey) {
  EXPECT_TRUE(IsScript(config::ParseYaml("script: []", "s")));
  EXPECT_FALSE(IsScript(config::ParseYaml("robot: {}", "s")));
  EXPECT_FALSE(IsScript(config::ParseYaml("[1]", "s")));
}

}  // namespace
}  // namespace understudy::script
