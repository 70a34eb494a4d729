#include <gmock/gmock.h>

#include "base/errors.h"
#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

class ScriptTest : public EmulatorTest {};

TEST_F(ScriptTest, GivesEachRequestToTheTickOfItsTime) {
  port_.TellEvery(1);
  StartAs("standing");
  world_->Play({{.at = 0.3, .request = test::RequestOf("clamp", true), .where = ""},
                {.at = 0.5, .request = test::RequestOf("clamp", false), .where = ""}});
  Tick(300);
  EXPECT_FALSE(world_->status().clamped);
  Tick();
  EXPECT_TRUE(world_->status().clamped);
  EXPECT_EQ(world_->status().script_done, 1U);
  Tick(200);
  EXPECT_FALSE(world_->status().clamped);
  EXPECT_EQ(world_->status().script_done, 2U);
}

TEST_F(ScriptTest, CallsServices) {
  config_.robot.services = {{.name = "ai_sport", .alias = "ai"}};
  StartAs("clamped");
  const auto call = [](const char* service) {
    return test::RequestOf("service.call",
                           {{"service", service}, {"api", 1003}, {"parameter", "{}"}});
  };
  world_->Play({{.at = 0.01, .request = call("release"), .where = ""},
                {.at = 0.02, .request = call("vui"), .where = "s.yaml:4"}});
  Tick(10);
  EXPECT_EQ(robot().owner().active(), "ai");
  Tick();
  EXPECT_EQ(robot().owner().active(), "");
  EXPECT_EQ(world_->status().script_refused, 0U);
  Tick(10);
  EXPECT_THAT(Told(EventKind::kScriptRefused),
              testing::ElementsAre("script: s.yaml:4: nothing serves 'vui'"));
}

TEST_F(ScriptTest, CountsWhatTheRobotRefusesAndSaysWhere) {
  StartAs("standing");
  world_->Play({{.at = 0, .request = test::RequestOf("crane.lower", 1), .where = "s.yaml:3"}});
  Tick();
  EXPECT_EQ(world_->status().script_refused, 1U);
  EXPECT_THAT(Told(EventKind::kScriptRefused),
              testing::ElementsAre("script: s.yaml:3: the robot does not hang from the crane"));
  EXPECT_THAT(Told(EventKind::kScript), testing::ElementsAre("s.yaml:3"));
}

TEST_F(ScriptTest, RefusesABodyThatTheModelDoesNotHave) {
  Start();
  EXPECT_THROW(
      world_->Play({{.at = 0,
                     .request = test::RequestOf("push", {{"body", "tail"}, {"force", {0, 0, 0}}}),
                     .where = "s:1"}}),
      ConfigError);
}

TEST_F(ScriptTest, RefusesARobotThatIsNotInTheWorld) {
  Start();
  EXPECT_THROW(world_->Play({{.at = 0,
                              .request = test::RequestOf("clamp", {{"on", true}, {"robot", 1}}),
                              .where = "s:1"}}),
               ConfigError);
}

TEST_F(ScriptTest, PausesStepsDragsAndLetsGo) {
  StartAs("clamped");
  world_->Play({{.at = 0.01, .request = test::RequestOf("pause"), .where = ""},
                {.at = 0.01, .request = test::RequestOf("step", 5), .where = ""},
                {.at = 0.01,
                 .request = test::RequestOf("drag", {{"body", "base"}, {"to", {0, 0, 2}}}),
                 .where = ""},
                {.at = 0.012, .request = test::RequestOf("let_go"), .where = ""}});
  Tick(11);
  EXPECT_TRUE(world_->status().paused);
  EXPECT_EQ(world_->drags().size(), 1u);
  EXPECT_EQ(world_->pace().steps_left, 4);  // the tick that was told made one
  Tick(4);
  EXPECT_TRUE(world_->pace().stands_still());
  EXPECT_TRUE(world_->drags().empty());
}

class PushTest : public EmulatorTest {
 protected:
  // Upward speed of a falling robot of 6 kg after so many ticks, pushed up by 60 N from the first.
  double SpeedAfter(int ticks, double seconds) {
    config_.start.pose = "hanging";
    Start();
    Ask("crane.release");
    Ask("push", {{"force", {0, 0, 60}}, {"for", seconds}});
    Tick(ticks);
    return world_->physics().robot().base().v_WB_W.z();
  }
};

TEST_F(PushTest, GivesTheRobotItsImpulse) {
  EXPECT_NEAR(SpeedAfter(150, 0.1), -10 * 0.15 + 60 * 0.1 / 6, 0.02);
}

TEST_F(PushTest, LastsAsLongAsItIsTold) {
  const double short_push = SpeedAfter(40, 0.01);
  EXPECT_NEAR(SpeedAfter(40, 0.02) - short_push, 60 * 0.01 / 6, 0.01);
}

TEST_F(PushTest, ByAnImpulseIsTheSameEvenlyOverItsTime) {
  const double by_force = SpeedAfter(150, 0.1);
  Start();
  Ask("crane.release");
  Ask("push", {{"impulse", {0, 0, 6}}, {"for", 0.1}});
  Tick(150);
  EXPECT_NEAR(world_->physics().robot().base().v_WB_W.z(), by_force, 1e-9);
}

TEST_F(PushTest, OfABodyThatIsNotThereIsRefused) {
  Start();
  EXPECT_EQ(Answered("push", {{"body", "tail"}, {"force", {1, 0, 0}}}),
            "the model has no body 'tail'");
}

TEST_F(PushTest, EndsWithAReset) {
  config_.start.pose = "clamped";
  Start();
  Ask("push", {{"force", {60, 0, 0}}, {"for", 100}});
  Ask("reset");
  Ask("clamp", false);
  Tick(100);
  EXPECT_NEAR(world_->physics().robot().base().v_WB_W.x(), 0, 1e-6);
}

}  // namespace
}  // namespace understudy::emulator
