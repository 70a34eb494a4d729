#include <future>

#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

class RequestsTest : public EmulatorTest {};

TEST_F(RequestsTest, AreAnswered) {
  StartAs("hanging");
  const std::pair<const char*, nlohmann::json> asked[] = {
      {"crane.lower", 0.1},
      {"crane.raise", 0.1},
      {"crane.release", nullptr},
      {"crane.attach", nullptr},
      {"clamp", true},
      {"clamp", false},
      {"reset", nullptr},
      {"drag", {{"body", "base"}, {"to", {0, 0, 0}}}},
      {"let_go", nullptr},
      {"pause", nullptr},
      {"step", {{"wait", false}}},
      {"speed", 2},
      {"resume", nullptr}};
  for (const auto& [name, values] : asked) EXPECT_EQ(Answered(name, values), "") << name;
}

TEST_F(RequestsTest, SayWhyTheyCannotBeCarriedOut) {
  StartAs("standing");
  EXPECT_EQ(Answered("crane.lower", 0.1), "the robot does not hang from the crane");
}

TEST_F(RequestsTest, AreCarriedOutInOrderInOneTick) {
  StartAs("standing");
  Ask("clamp", true);
  Ask("clamp", false);
  Ask("crane.attach");
  Tick();
  EXPECT_FALSE(world_->status(0).clamped);
  EXPECT_TRUE(world_->status(0).crane_attached);
}

TEST_F(RequestsTest, LowerTheRobotToTheGround) {
  StartAs("hanging");
  Ask("crane.lower", 0.2);
  Tick(3000);
  EXPECT_NEAR(Height(), 0.8, 0.005);
  EXPECT_NEAR(world_->status(0).crane_length, config_.robots[0].crane.length + 0.2, 1e-9);
  Ask("crane.lower", -0.1);
  Tick(2000);
  EXPECT_NEAR(Height(), 0.9, 0.005);
}

TEST_F(RequestsTest, ReleaseTheRobot) {
  StartAs("hanging");
  Tick(10);
  Ask("crane.release");
  Tick(200);
  EXPECT_NEAR(Height(), 0.8, 0.01);  // 10 / 2 · 0.2²
  EXPECT_EQ(world_->status(0).crane_tension, 0);
  EXPECT_FALSE(world_->status(0).crane_attached);
}

TEST_F(RequestsTest, CatchAFallingRobot) {
  StartAs("hanging");
  Ask("crane.release");
  Tick(200);
  Ask("crane.attach");
  Tick(3000);
  EXPECT_NEAR(Height(), 0.8, 0.1);
  EXPECT_NEAR(world_->status(0).crane_tension, 60, 1);
}

TEST_F(RequestsTest, ClampTheBaseWhereItIs) {
  StartAs("hanging");
  Ask("crane.release");
  Tick(200);
  Ask("clamp", true);
  Tick(1000);
  EXPECT_NEAR(Height(), 0.8, 0.02);
  EXPECT_NEAR(world_->physics().robot().base().v_WB_W.norm(), 0, 1e-3);
  Ask("clamp", false);
  Tick(200);
  EXPECT_LT(Height(), 0.7);
}

TEST_F(RequestsTest, ResetTheRobotWhileTimeGoesOn) {
  StartAs("hanging");
  Ask("crane.release");
  port_.Send(Torque(1));
  Tick(300);
  ASSERT_EQ(world_->status(0).gate, authority::GateState::kDamping);
  Ask("reset");
  Tick();
  EXPECT_EQ(Height(), 1);
  EXPECT_TRUE(world_->status(0).crane_attached);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kStart);
  EXPECT_EQ(world_->status(0).commands.accepted, 1U);
  EXPECT_EQ(world_->step(), 301);
  EXPECT_EQ(port_.last().state.tick_ms, 300);
}

TEST_F(RequestsTest, ResetTheRobotToTheirPoseAndToTheStartPoseWithoutOne) {
  StartAs("standing");
  Tick();
  EXPECT_EQ(Answered("reset", "hanging"), "");
  EXPECT_NEAR(Height(), 1, 1e-3);
  EXPECT_TRUE(world_->status(0).crane_attached);
  EXPECT_EQ(Answered("reset", "clamped"), "");
  EXPECT_FALSE(world_->status(0).crane_attached);
  EXPECT_TRUE(world_->status(0).clamped);
  EXPECT_EQ(Answered("reset", "lying"), "");
  EXPECT_NEAR(Height(), 0.06, 0.01);
  EXPECT_FALSE(world_->status(0).clamped);
  EXPECT_EQ(Answered("reset"), "");
  EXPECT_NEAR(Height(), 0.3, 0.01);
}

// A robot that began limp is held up as one that began standing, by command too where commands
// come late.
TEST_F(RequestsTest, ResetToStandingKeepsTheRobotStanding) {
  config_.robots[0].spec.dynamics.delay = 0.005;
  StartAs("lying");
  Tick(10);
  Ask("reset", "standing");
  Tick(1000);
  EXPECT_NEAR(Height(), 0.3, 0.02);
  EXPECT_EQ(robot().command().motors[0].kp, config_.robots[0].spec.motors[0].hold_kp);
  Ask("reset");
  Tick(1000);
  EXPECT_LT(Height(), 0.1);
}

TEST_F(RequestsTest, ResetNoHumanoidToStandingWithNobodyToBalanceIt) {
  config_.robots[0].spec.kind = robot::RobotKind::kHumanoid;
  config_.robots[0].spec.services = {{.name = "ai_sport", .alias = "ai"}};
  StartAs("clamped");
  Tick();
  EXPECT_EQ(Answered("reset", "standing"), "");
  services_.Call([](authority::MotorOwner* owner) { owner->Release(); });
  Tick();
  EXPECT_EQ(Answered("reset", "standing"),
            "a standing humanoid falls while no motion service balances it; reset it hanging or "
            "clamped");
  EXPECT_EQ(Answered("reset", "hanging"), "");
}

TEST_F(RequestsTest, SetThePaceThatWhoeverTicksKeepsTo) {
  Start();
  EXPECT_FALSE(world_->pace().stands_still());
  Ask("pause");
  world_->Attend({});
  EXPECT_TRUE(world_->pace().stands_still());
  EXPECT_TRUE(world_->status(0).paused);
  EXPECT_EQ(world_->step(), 0);

  Ask("step", 2);
  world_->Attend({});
  for (int left = 2; left > 0; --left) {
    EXPECT_EQ(world_->status(0).steps_left, left);
    EXPECT_FALSE(world_->pace().stands_still());
    Tick();
  }
  EXPECT_TRUE(world_->pace().stands_still());

  Ask("speed", 0.5);
  Ask("resume");
  world_->Attend({});
  EXPECT_FALSE(world_->pace().stands_still());
  EXPECT_EQ(world_->status(0).speed, 0.5);
}

TEST_F(RequestsTest, StepOnlyAPausedRobotAndForgetStepsWithThePause) {
  Start();
  EXPECT_EQ(Answered("step"), "the robot is not paused");
  Ask("pause");
  Ask("step", 10);
  Ask("pause");
  Tick();
  EXPECT_TRUE(world_->pace().stands_still());
}

TEST_F(RequestsTest, ForStepsAreAnsweredWhenTheStepsAreMade) {
  Start();
  Ask("pause");
  auto asked = inbox_.Put(test::RequestOf("step", 2));
  const auto answered = [&] {
    world_->Attend({});
    return asked->answer.wait_for(std::chrono::seconds{0}) == std::future_status::ready;
  };
  EXPECT_FALSE(answered());
  Tick();
  EXPECT_FALSE(answered());
  Tick();
  EXPECT_TRUE(answered());
  EXPECT_TRUE(asked->answer.get());
}

TEST_F(RequestsTest, ForStepsThatAPauseForgetsAreRefused) {
  Start();
  Ask("pause");
  auto asked = inbox_.Put(test::RequestOf("step", 2));
  world_->Attend({});
  Ask("pause");
  world_->Attend({});
  world_->Attend({});
  EXPECT_EQ(asked->answer.get().why(), "the robot was paused before all steps were made");
}

TEST_F(RequestsTest, ForStepsThatNeedNotBeAwaitedAreAnsweredAtOnce) {
  Start();
  Ask("pause");
  EXPECT_EQ(Answered("step", {{"steps", 100}, {"wait", false}}), "");
}

TEST_F(RequestsTest, BetweenTicksActInTheNext) {
  StartAs("hanging");
  Ask("crane.release");
  world_->Attend({});
  EXPECT_FALSE(world_->status(0).crane_attached);
  EXPECT_TRUE(port_.samples().empty());
}

TEST_F(RequestsTest, ShowWhatActsOnTheRobot) {
  StartAs("clamped");
  Tick();
  EXPECT_TRUE(world_->pushes(0).empty());
  EXPECT_TRUE(world_->drags(0).empty());
  Ask("push", {{"force", {1, 2, 3}}, {"for", 0.002}});
  Ask("drag", {{"body", "base"}, {"at", {0, 0, 0.1}}, {"to", {0, 0, 1.2}}, {"for", 0.001}});
  Tick();
  ASSERT_EQ(world_->pushes(0).size(), 1U);
  EXPECT_EQ(world_->pushes(0)[0].force_W, Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(world_->drags(0).size(), 1U);
  EXPECT_NEAR(world_->drags(0)[0].p_WP.z(), 1.1, 1e-3);
  EXPECT_NEAR(world_->drags(0)[0].force_W.z(), 60, 1);  // 6 kg · 100 1/s² · 0.1 m
  Tick(2);
  EXPECT_TRUE(world_->pushes(0).empty());
  EXPECT_TRUE(world_->drags(0).empty());
}

TEST_F(RequestsTest, AreRefusedForWhatCannotBeDraggedOrPushed) {
  Start();
  EXPECT_EQ(Answered("drag", {{"body", "tail"}, {"to", {0, 0, 0}}}),
            "the model has no body 'tail'; valid: base, RL_leg, FR_leg, head, FL_leg, RR_leg");
  EXPECT_EQ(
      Answered("drag", {{"body", "bass"}, {"to", {0, 0, 0}}}),
      "the model has no body 'bass'; did you mean 'base'? (valid: base, RL_leg, FR_leg, head, "
      "FL_leg, RR_leg)");
  EXPECT_EQ(Answered("drag", {{"body", "world"}, {"to", {0, 0, 0}}}), "'world' does not move");
  EXPECT_EQ(Answered("let_go", "tail"),
            "the model has no body 'tail'; valid: base, RL_leg, FR_leg, head, FL_leg, RR_leg");
  EXPECT_EQ(Answered("push", {{"body", "world"}, {"force", {1, 0, 0}}, {"for", 1}}),
            "'world' does not move");
}

TEST_F(RequestsTest, TakeTheTorqueOfALimpMotorAndGiveItBack) {
  StartAs("clamped");
  port_.SendEveryTick(Torque(1));
  Tick();
  EXPECT_EQ(Answered("fault", {{"component", "FL_joint"}, {"fault", "limp"}}), "");
  EXPECT_EQ(robot().torque()[1], 0);
  EXPECT_EQ(robot().torque()[0], 1);
  Answered("reset");
  EXPECT_EQ(robot().torque()[1], 0);
  EXPECT_EQ(Answered("fault", {{"component", "FL_joint"}, {"fault", "none"}}), "");
  EXPECT_EQ(robot().torque()[1], 1);
}

TEST_F(RequestsTest, KeepAJammedJointFromTurningWhateverPushesIt) {
  config_.robots[0].spec.battery.internal_ohm = 0;  // gives what the joints take that turn
  StartAs("clamped");
  port_.SendEveryTick(Torque(10));
  Answered("fault", {{"component", "RR_joint"}, {"fault", "jammed"}});
  Tick(500);
  const auto q = [this](std::size_t motor) { return world_->physics().robot().q()[motor]; };
  EXPECT_NEAR(q(2), 0, 0.01);
  EXPECT_GT(q(0), 0.5);
  EXPECT_EQ(robot().torque()[2], 10);
  Answered("fault", {{"component", "RR_joint"}, {"fault", "none"}});
  Tick(500);
  EXPECT_GT(q(2), 0.5);
}

TEST_F(RequestsTest, GiveFaultsToMotorsOfEveryGroupAndToNoOthers) {
  config_.robots[0].spec = test::FixtureRobotWithHand();
  StartAs("clamped");
  EXPECT_EQ(Answered("fault", {{"component", "neck_roll_joint"}, {"fault", "limp"}}), "");
  EXPECT_EQ(Answered("fault", {{"component", "FR_joint"}, {"fault", "jammed"}}), "");
  EXPECT_EQ(Answered("fault", {{"component", "FR_joint"}, {"fault", "none"}}), "");
  EXPECT_EQ(Answered("fault", {{"component", "FX_joint"}, {"fault", "limp"}}),
            "the robot has no 'FX_joint'; did you mean 'FR_joint'?");
  EXPECT_THAT(Told(EventKind::kFault),
              testing::ElementsAre("neck_roll_joint is limp", "FR_joint is jammed",
                                   "FR_joint is no longer jammed"));
}

TEST_F(RequestsTest, ADragEndsWithAReset) {
  StartAs("clamped");
  Ask("drag", {{"body", "base"}, {"to", {5, 0, 1}}, {"for", 60}});
  Ask("reset");
  Tick();
  EXPECT_TRUE(world_->drags(0).empty());
}

TEST_F(RequestsTest, AreEventsWhenTheyAreCarriedOut) {
  StartAs("clamped");
  Tick();
  Answered("push", {{"force", {0, 5, 0}}, {"for", 0.01}});
  Answered("push", {{"body", "tail"}, {"force", {0, 5, 0}}});  // refused
  Answered("speed", 2);                                        // another event
  for (int i = 0; i < 3; ++i) Answered("drag", {{"body", "base"}, {"to", {0, 0, 0}}});  // renewed
  Answered("let_go");
  Answered("reset");
  EXPECT_THAT(Told(EventKind::kRequest),
              testing::ElementsAre("push base 0 5 0 N for 0.01 s",
                                   testing::StartsWith("drag base "), "let_go", "reset clamped"));
  EXPECT_THAT(Told(EventKind::kSpeed), testing::ElementsAre("speed 2"));
}

TEST_F(RequestsTest, AreEventsOfTheStepInWhichTheyAct) {
  StartAs("hanging");
  Tick(3);
  Answered("crane.release");
  Answered("pause");
  EventRing::Reader reader(&world_->events());
  std::vector<std::int64_t> steps;
  for (Event event; reader.Next(&event);) {
    if (event.kind == EventKind::kCrane || event.kind == EventKind::kPause) {
      steps.push_back(event.step);
    }
  }
  EXPECT_THAT(steps, testing::ElementsAre(0, 3, 4));
  EXPECT_THAT(Told(EventKind::kCrane),
              testing::ElementsAre("hangs from the crane", "released from the crane"));
}

}  // namespace
}  // namespace understudy::emulator
