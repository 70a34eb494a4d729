#include <future>

#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

class OrdersTest : public EmulatorTest {
 protected:
  // What the next tick answers.
  Answer Ask(const understudy::emulator::Order& order) {
    auto answer = inbox_.Put(order, Inbox::WallTime::max());
    Tick();
    return answer->get();
  }
};

TEST_F(OrdersTest, AreAnswered) {
  StartAs("hanging");
  for (const understudy::emulator::Order& order :
       std::initializer_list<understudy::emulator::Order>{
           LowerCrane{.by = 0.1}, ReleaseCrane{}, AttachCrane{}, ClampBase{.on = true},
           ClampBase{.on = false}, ResetRobot{}, DragBody{.body = "base"}, ReleaseDrag{},
           PauseRun{}, StepRun{}, SetSpeed{.speed = 2}, PauseRun{.on = false}}) {
    EXPECT_EQ(Ask(order), "") << order.index();
  }
}

TEST_F(OrdersTest, SayWhyTheyCannotBeCarriedOut) {
  StartAs("standing");
  EXPECT_EQ(Ask(LowerCrane{.by = 0.1}), "the robot does not hang from the crane");
}

TEST_F(OrdersTest, AreCarriedOutInOrderInOneTick) {
  StartAs("standing");
  Order(ClampBase{.on = true});
  Order(ClampBase{.on = false});
  Order(AttachCrane{});
  Tick();
  EXPECT_FALSE(world_->status().clamped);
  EXPECT_TRUE(world_->status().crane_attached);
}

TEST_F(OrdersTest, LowerTheRobotToTheGround) {
  StartAs("hanging");
  Order(LowerCrane{.by = 0.2});
  Tick(3000);
  EXPECT_NEAR(Height(), 0.8, 0.005);
  EXPECT_NEAR(world_->status().crane_length, config_.crane.length + 0.2, 1e-9);
  Order(LowerCrane{.by = -0.1});
  Tick(2000);
  EXPECT_NEAR(Height(), 0.9, 0.005);
}

TEST_F(OrdersTest, ReleaseTheRobot) {
  StartAs("hanging");
  Tick(10);
  Order(ReleaseCrane{});
  Tick(200);
  EXPECT_NEAR(Height(), 0.8, 0.01);  // 10 / 2 · 0.2²
  EXPECT_EQ(world_->status().crane_tension, 0);
  EXPECT_FALSE(world_->status().crane_attached);
}

TEST_F(OrdersTest, CatchAFallingRobot) {
  StartAs("hanging");
  Order(ReleaseCrane{});
  Tick(200);
  Order(AttachCrane{});
  Tick(3000);
  EXPECT_NEAR(Height(), 0.8, 0.1);
  EXPECT_NEAR(world_->status().crane_tension, 60, 1);
}

TEST_F(OrdersTest, ClampTheBaseWhereItIs) {
  StartAs("hanging");
  Order(ReleaseCrane{});
  Tick(200);
  Order(ClampBase{.on = true});
  Tick(1000);
  EXPECT_NEAR(Height(), 0.8, 0.02);
  EXPECT_NEAR(world_->physics().base().v_WB_W.norm(), 0, 1e-3);
  Order(ClampBase{.on = false});
  Tick(200);
  EXPECT_LT(Height(), 0.7);
}

TEST_F(OrdersTest, ResetTheRobotWhileTimeGoesOn) {
  StartAs("hanging");
  Order(ReleaseCrane{});
  port_.Send(Torque(1));
  Tick(300);
  ASSERT_EQ(world_->status().gate, authority::GateState::kDamping);
  Order(ResetRobot{});
  Tick();
  EXPECT_EQ(Height(), 1);
  EXPECT_TRUE(world_->status().crane_attached);
  EXPECT_EQ(world_->status().gate, authority::GateState::kStart);
  EXPECT_EQ(world_->status().commands.accepted, 1U);
  EXPECT_EQ(world_->step(), 301);
  EXPECT_EQ(port_.last().state.tick_ms, 300);
}

TEST_F(OrdersTest, ResetTheRobotToTheirPoseAndToTheStartPoseWithoutOne) {
  StartAs("standing");
  Tick();
  EXPECT_EQ(Ask(ResetRobot{.pose = robot::StartPose::kHanging}), "");
  EXPECT_NEAR(Height(), 1, 1e-3);
  EXPECT_TRUE(world_->status().crane_attached);
  EXPECT_EQ(Ask(ResetRobot{.pose = robot::StartPose::kClamped}), "");
  EXPECT_FALSE(world_->status().crane_attached);
  EXPECT_TRUE(world_->status().clamped);
  EXPECT_EQ(Ask(ResetRobot{.pose = robot::StartPose::kLying}), "");
  EXPECT_NEAR(Height(), 0.06, 0.01);
  EXPECT_FALSE(world_->status().clamped);
  EXPECT_EQ(Ask(ResetRobot{}), "");
  EXPECT_NEAR(Height(), 0.3, 0.01);
}

// A robot that began limp is held up as one that began standing, by command too where commands
// come late.
TEST_F(OrdersTest, ResetToStandingKeepsTheRobotStanding) {
  config_.robot.dynamics.delay = 0.005;
  StartAs("damped");
  Tick(10);
  Order(ResetRobot{.pose = robot::StartPose::kStanding});
  Tick(1000);
  EXPECT_NEAR(Height(), 0.3, 0.02);
  EXPECT_EQ(robot().command().motors[0].kp, config_.robot.motors[0].hold_kp);
  Order(ResetRobot{});
  Tick(1000);
  EXPECT_LT(Height(), 0.1);
}

TEST_F(OrdersTest, SetThePaceThatWhoeverTicksKeepsTo) {
  Start();
  EXPECT_FALSE(world_->pace().stands_still());
  Order(PauseRun{});
  world_->Attend({});
  EXPECT_TRUE(world_->pace().stands_still());
  EXPECT_TRUE(world_->status().paused);
  EXPECT_EQ(world_->step(), 0);

  Order(StepRun{.steps = 2});
  world_->Attend({});
  for (int left = 2; left > 0; --left) {
    EXPECT_EQ(world_->status().steps_left, left);
    EXPECT_FALSE(world_->pace().stands_still());
    Tick();
  }
  EXPECT_TRUE(world_->pace().stands_still());

  Order(SetSpeed{.speed = 0.5});
  Order(PauseRun{.on = false});
  world_->Attend({});
  EXPECT_FALSE(world_->pace().stands_still());
  EXPECT_EQ(world_->status().speed, 0.5);
}

TEST_F(OrdersTest, StepOnlyAPausedRobotAndForgetStepsWithThePause) {
  Start();
  EXPECT_EQ(Ask(StepRun{}), "the robot is not paused");
  Order(PauseRun{});
  Order(StepRun{.steps = 10});
  Order(PauseRun{});
  Tick();
  EXPECT_TRUE(world_->pace().stands_still());
}

TEST_F(OrdersTest, BetweenTicksActInTheNext) {
  StartAs("hanging");
  Order(ReleaseCrane{});
  world_->Attend({});
  EXPECT_FALSE(world_->status().crane_attached);
  EXPECT_TRUE(port_.samples().empty());
}

TEST_F(OrdersTest, ShowWhatActsOnTheRobot) {
  StartAs("clamped");
  Tick();
  EXPECT_TRUE(world_->pushes().empty());
  EXPECT_TRUE(world_->drags().empty());
  Order(PushBody{.force = {1, 2, 3}, .seconds = 0.002});
  Order(DragBody{.body = "base", .p_BP = {0, 0, 0.1}, .p_WT = {0, 0, 1.2}, .seconds = 0.001});
  Tick();
  ASSERT_EQ(world_->pushes().size(), 1U);
  EXPECT_EQ(world_->pushes()[0].force_W, Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(world_->drags().size(), 1U);
  EXPECT_NEAR(world_->drags()[0].p_WP.z(), 1.1, 1e-3);
  EXPECT_NEAR(world_->drags()[0].force_W.z(), 60, 1);  // 6 kg · 100 1/s² · 0.1 m
  Tick(2);
  EXPECT_TRUE(world_->pushes().empty());
  EXPECT_TRUE(world_->drags().empty());
}

TEST_F(OrdersTest, AreRefusedForWhatCannotBeDraggedOrPushed) {
  Start();
  EXPECT_EQ(Ask(DragBody{.body = "tail"}), "the model has no body 'tail'");
  EXPECT_EQ(Ask(DragBody{.body = "bass"}), "the model has no body 'bass'; did you mean 'base'?");
  EXPECT_EQ(Ask(DragBody{.body = "world"}), "'world' does not move");
  EXPECT_EQ(Ask(ReleaseDrag{.body = "tail"}), "the model has no body 'tail'");
  EXPECT_EQ(Ask(PushBody{.body = "world", .force = {1, 0, 0}, .seconds = 1}),
            "'world' does not move");
}

TEST_F(OrdersTest, ADragEndsWithAReset) {
  StartAs("clamped");
  Order(DragBody{.body = "base", .p_WT = {5, 0, 1}, .seconds = 100});
  Order(ResetRobot{});
  Tick();
  EXPECT_TRUE(world_->drags().empty());
}

TEST_F(OrdersTest, AreNotedWhenAStatusWouldNotShowThem) {
  StartAs("clamped");
  Tick();
  Ask(PushBody{.force = {0, 5, 0}, .seconds = 0.01});
  Ask(PushBody{.body = "tail"});                              // refused
  Ask(SetSpeed{.speed = 2});                                  // shown
  for (int i = 0; i < 3; ++i) Ask(DragBody{.body = "base"});  // renewed
  Ask(ReleaseDrag{});
  Ask(ResetRobot{});
  const OrderNotes notes = world_->status().orders;
  ASSERT_EQ(notes.count, 4u);
  EXPECT_EQ(Describe(notes[0]), "push base by 0 5 0 N for 0.01 s");
  EXPECT_EQ(notes[0].time, 0.001);
  EXPECT_EQ(notes[1].kind, OrderKind::kDrag);
  EXPECT_EQ(notes[2].kind, OrderKind::kLetGo);
  EXPECT_EQ(Describe(notes[3]), "reset to clamped");
}

}  // namespace
}  // namespace understudy::emulator
