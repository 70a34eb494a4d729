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
template <class Kind>
Kind One(const std::string& event) {
  return std::get<Kind>(Read("script: [" + event + "]").front().order);
}

TEST(ScriptTest, ReadsEveryEvent) {
  EXPECT_EQ(One<emulator::PressRemote>("{at: 1, press: L2+B}").keys, 0x220);
  EXPECT_EQ(One<emulator::PressRemote>("{at: 1, press: A, for: 2}").seconds, 2);
  EXPECT_EQ(One<emulator::HoldRemote>("{at: 1, hold: L2}").keys, 0x20);
  EXPECT_EQ(One<emulator::ReleaseRemote>("{at: 1, release: L2}").keys, 0x20);
  EXPECT_EQ(One<emulator::MoveSticks>("{at: 1, sticks: {ly: 0.5}, for: 2}").ly, 0.5);
  EXPECT_FALSE(One<emulator::SwitchRemote>("{at: 1, remote: off}").on);
  One<emulator::AttachCrane>("{at: 1, crane: attach}");
  One<emulator::ReleaseCrane>("{at: 1, crane: release}");
  EXPECT_EQ(One<emulator::LowerCrane>("{at: 1, crane: {lower: 0.2}}").by, 0.2);
  EXPECT_EQ(One<emulator::LowerCrane>("{at: 1, crane: {raise: 0.2}}").by, -0.2);
  EXPECT_TRUE(One<emulator::ClampBase>("{at: 1, clamp: on}").on);
  EXPECT_EQ(One<emulator::ResetRobot>("{at: 1, reset: true}").pose, std::nullopt);
  EXPECT_EQ(One<emulator::ResetRobot>("{at: 1, reset: standing}").pose,
            robot::StartPose::kStanding);
  EXPECT_EQ(One<emulator::SetSpeed>("{at: 1, speed: 0.5}").speed, 0.5);
  EXPECT_EQ(One<emulator::SetSpeed>("{at: 1, speed: max}").speed, 0);
}

TEST(ScriptTest, ReadsAPushByForceOrImpulse) {
  const auto force =
      One<emulator::PushBody>("{at: 1, push: {body: trunk, force: [1, 2, -3]}, for: 0.1}");
  EXPECT_EQ(force.body, "trunk");
  EXPECT_EQ(force.force, Eigen::Vector3d(1, 2, -3));
  EXPECT_EQ(force.seconds, 0.1);
  const auto impulse = One<emulator::PushBody>("{at: 1, push: {impulse: [0, 5, 0]}, for: 0.25}");
  EXPECT_EQ(impulse.body, "");
  EXPECT_EQ(impulse.force, Eigen::Vector3d(0, 20, 0));
}

TEST(ScriptTest, SortsByTimeAndKeepsTheOrderOfEqualTimes) {
  const auto events = Read("script:\n- {at: 2, hold: A}\n- {at: 1, hold: B}\n- {at: 2, hold: X}\n");
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].at, 1);
  EXPECT_EQ(events[0].where, "s:3");
  EXPECT_EQ(std::get<emulator::HoldRemote>(events[1].order).keys, 0x100);
  EXPECT_EQ(std::get<emulator::HoldRemote>(events[2].order).keys, 0x400);
}

TEST(ScriptTest, SaysWhereAndWhatIsWrong) {
  EXPECT_EQ(ErrorIn("{press: A}"), "s:2: at: missing; when is it to happen?");
  EXPECT_EQ(ErrorIn("{at: soon, press: A}"), "s:2: at: expected seconds, got 'soon'");
  EXPECT_EQ(ErrorIn("{at: -1, press: A}"), "s:2: at: expected seconds, got '-1'");
  EXPECT_EQ(ErrorIn("{at: 1, press: L3}"),
            "s:2: press: expected keys of the remote controller, as in L2+B, got 'L3'");
  EXPECT_EQ(ErrorIn("{at: 1, press: A, hold: B}"), "s:2: one event cannot be both press and hold");
  EXPECT_EQ(ErrorIn("{at: 1, hold: A, for: 1}"), "s:2: for: hold takes no time");
  EXPECT_EQ(ErrorIn("{at: 1, push: {force: [1, 2, 3]}}"),
            "s:2: push: needs a time to act, as in for: 0.1");
  EXPECT_EQ(ErrorIn("{at: 1, push: {force: [1, 2]}, for: 1}"),
            "s:2: push.force: expected three numbers, got a list");
  EXPECT_EQ(ErrorIn("{at: 1, crane: {lower: far}}"),
            "s:2: crane.lower: expected metres, got 'far'");
  EXPECT_EQ(ErrorIn("{at: 1, sticks: {ly: 2}}"),
            "s:2: sticks.ly: expected a number from -1 to 1, got '2'");
  EXPECT_EQ(ErrorIn("{at: 1, clamp: maybe}"), "s:2: clamp: expected on or off, got 'maybe'");
  EXPECT_EQ(ErrorIn("{at: 1, reset: sitting}"),
            "s:2: reset: expected true, lying, standing, hanging or clamped, got 'sitting'");
  EXPECT_EQ(ErrorIn("{at: 1, speed: 0.0001}"),
            "s:2: speed: expected 0 (as fast as possible) or 0.001 to 1000, got '0.0001'");
  EXPECT_EQ(ErrorIn("{at: 1, pause: on}").substr(0, 29), "s:2: unknown key 'pause'; did");
  EXPECT_EQ(ErrorIn("5"), "s:2: script: expected an event, as in {at: 1.5, press: L2+B}, got '5'");
}

TEST(ScriptTest, NamesTheNearestOfAnUnknownKey) {
  EXPECT_THAT(ErrorIn("{at: 1, pres: A}"), testing::StartsWith("s:2: unknown key 'pres'; did you "
                                                               "mean 'press'?"));
  EXPECT_THAT(config::ErrorOf([] { Read("script: []\nrobot: {}\n"); }),
              testing::StartsWith("s:2: unknown key 'robot'"));
}

TEST(ScriptTest, IsKnownByItsKey) {
  EXPECT_TRUE(IsScript(config::ParseYaml("script: []", "s")));
  EXPECT_FALSE(IsScript(config::ParseYaml("robot: {}", "s")));
  EXPECT_FALSE(IsScript(config::ParseYaml("[1]", "s")));
}

}  // namespace
}  // namespace understudy::script
