#include <gmock/gmock.h>

#include "base/errors.h"
#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

// Conditions that hold when the test says so.
class SaidConditions final : public ScriptConditions {
 public:
  explicit SaidConditions(const std::vector<bool>* hold) : hold_(hold) {}

  void Look(const World&, bool) override {}
  bool Holds(std::size_t condition) const override { return (*hold_)[condition]; }

 private:
  const std::vector<bool>* hold_;
};

class ScriptTest : public EmulatorTest {
 protected:
  void Play(const std::vector<ScriptEvent>& events) {
    world_->Play(events, std::make_unique<SaidConditions>(&holds_));
  }
  static ScriptEvent Event(const char* where, const char* keys, ScriptEvent event) {
    event.where = where;
    event.request = test::RequestOf("remote.hold", keys);
    return event;
  }

  std::vector<bool> holds_ = std::vector<bool>(4, false);
};

TEST_F(ScriptTest, AnEventWaitsForItsCondition) {
  StartAs("standing");
  Play({Event("s:1", "A", {.at = 0.005, .when = 0, .condition = "a"})});
  holds_[0] = true;
  Tick(3);
  EXPECT_EQ(world_->status(0).script_done, 0U);  // not before its time
  holds_[0] = false;
  Tick(7);
  EXPECT_EQ(world_->status(0).script_done, 0U);
  holds_[0] = true;
  Tick();
  EXPECT_EQ(world_->status(0).script_done, 1U);
  EXPECT_THAT(Told(EventKind::kScriptWait), testing::ElementsAre("script: waited 0.005 s for 'a'"));
  EXPECT_THAT(Told(EventKind::kScript), testing::ElementsAre("s:1"));
}

TEST_F(ScriptTest, WhatComesAfterAnEventCountsFromItsEnd) {
  StartAs("standing");
  Play({Event("s:1", "A", {.when = 0, .condition = "a"}),
        Event("s:2", "B", {.at = 0.01, .after = true}),
        Event("s:3", "X", {.after = true, .when = 1, .condition = "b"}),
        Event("s:4", "Y", {.after = true})});
  holds_[1] = true;
  Tick(20);
  EXPECT_EQ(world_->status(0).script_done, 0U);
  holds_[0] = true;
  Tick();
  EXPECT_EQ(world_->status(0).script_done, 1U);
  Tick(9);
  EXPECT_EQ(world_->status(0).script_done, 1U);
  Tick();
  EXPECT_EQ(world_->status(0).script_done, 4U);  // the others at once, in their order
  EXPECT_THAT(Told(EventKind::kScript), testing::ElementsAre("s:1", "s:2", "s:3", "s:4"));
}

TEST_F(ScriptTest, AnEventThatHasWaitedTooLongIsRefusedAndTheScriptGoesOn) {
  StartAs("standing");
  Play({Event("s:1", "A", {.when = 0, .condition = "a > 1", .within = 0.01}),
        Event("s:2", "B", {.at = 0.005, .after = true})});
  Tick(10);
  EXPECT_EQ(world_->status(0).script_done, 0U);
  Tick();
  EXPECT_EQ(world_->status(0).script_done, 1U);
  EXPECT_EQ(world_->status(0).script_refused, 1U);
  EXPECT_THAT(Told(EventKind::kScriptRefused),
              testing::ElementsAre("script: s:1: timed out after 0.01 s: a > 1"));
  EXPECT_THAT(Told(EventKind::kScriptWait),
              testing::ElementsAre("script: timed out after 0.010 s waiting for 'a > 1'"));
  Tick(5);
  EXPECT_EQ(world_->status(0).script_done, 2U);
  EXPECT_EQ(world_->status(0).script_refused, 1U);
  EXPECT_THAT(Told(EventKind::kScript), testing::ElementsAre("s:2"));
}

TEST_F(ScriptTest, AConditionThatHoldsAtTheLastInstantIsInTime) {
  StartAs("standing");
  Play({Event("s:1", "A", {.when = 0, .within = 0.01})});
  Tick(10);
  holds_[0] = true;
  Tick();
  EXPECT_EQ(world_->status(0).script_done, 1U);
  EXPECT_EQ(world_->status(0).script_refused, 0U);
}

TEST_F(ScriptTest, SequencesWaitBesideEachOtherAndTheStatusTellsOfTheFirst) {
  StartAs("standing");
  Play({Event("s:1", "A", {.when = 0, .condition = "a"}),
        Event("s:2", "B", {.when = 1, .condition = "b"}), Event("s:3", "X", {.at = 0.005}),
        Event("s:4", "Y", {.at = 0.5, .when = 2})});
  Tick(20);
  Status status = world_->status(0);
  EXPECT_EQ(status.script_done, 1U);
  EXPECT_EQ(status.script_waiting, 2U);  // the last has not begun
  EXPECT_STREQ(status.script_where.data(), "s:1");
  EXPECT_STREQ(status.script_waits_for.data(), "a");
  holds_[0] = true;
  Tick();
  status = world_->status(0);
  EXPECT_EQ(status.script_waiting, 1U);
  EXPECT_STREQ(status.script_where.data(), "s:2");
  EXPECT_STREQ(status.script_waits_for.data(), "b");
}

TEST_F(ScriptTest, GivesEachRequestToTheTickOfItsTime) {
  port_.TellEvery(1);
  StartAs("standing");
  world_->Play({{.at = 0.3, .request = test::RequestOf("clamp", true), .where = ""},
                {.at = 0.5, .request = test::RequestOf("clamp", false), .where = ""}});
  Tick(300);
  EXPECT_FALSE(world_->status(0).clamped);
  Tick();
  EXPECT_TRUE(world_->status(0).clamped);
  EXPECT_EQ(world_->status(0).script_done, 1U);
  Tick(200);
  EXPECT_FALSE(world_->status(0).clamped);
  EXPECT_EQ(world_->status(0).script_done, 2U);
}

TEST_F(ScriptTest, CallsServices) {
  config_.robots[0].spec.services = {{.name = "ai_sport", .alias = "ai"}};
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
  EXPECT_EQ(world_->status(0).script_refused, 0U);
  Tick(10);
  EXPECT_THAT(Told(EventKind::kScriptRefused),
              testing::ElementsAre("script: s.yaml:4: nothing serves 'vui'"));
}

TEST_F(ScriptTest, CountsWhatTheRobotRefusesAndSaysWhere) {
  StartAs("standing");
  world_->Play({{.at = 0, .request = test::RequestOf("crane.lower", 1), .where = "s.yaml:3"}});
  Tick();
  EXPECT_EQ(world_->status(0).script_refused, 1U);
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
  EXPECT_TRUE(world_->status(0).paused);
  EXPECT_EQ(world_->drags(0).size(), 1u);
  EXPECT_EQ(world_->pace().steps_left, 4);  // the tick that was told made one
  Tick(4);
  EXPECT_TRUE(world_->pace().stands_still());
  EXPECT_TRUE(world_->drags(0).empty());
}

class PushTest : public EmulatorTest {
 protected:
  // Upward speed of a falling robot of 6 kg after so many ticks, pushed up by 60 N from the first.
  double SpeedAfter(int ticks, double seconds) {
    config_.robots[0].start.pose = "hanging";
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
            "the model has no body 'tail'; valid: base, RL_leg, FR_leg, head, FL_leg, RR_leg");
}

TEST_F(PushTest, EndsWithAReset) {
  config_.robots[0].start.pose = "clamped";
  Start();
  Ask("push", {{"force", {60, 0, 0}}, {"for", 100}});
  Ask("reset");
  Ask("clamp", false);
  Tick(100);
  EXPECT_NEAR(world_->physics().robot().base().v_WB_W.x(), 0, 1e-6);
}

}  // namespace
}  // namespace understudy::emulator
