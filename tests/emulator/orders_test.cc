#include <future>

#include "tests/emulator/emulator_test.h"

namespace understudy {
namespace {

class OrdersTest : public EmulatorTest {
 protected:
  // What the next tick answers.
  Answer Ask(const understudy::Order& order) {
    auto answer = inbox_.Put(order, Inbox::WallTime::max());
    Tick();
    return answer->get();
  }
};

TEST_F(OrdersTest, AreAnswered) {
  StartAs("hanging");
  for (const understudy::Order& order : std::initializer_list<understudy::Order>{
           LowerCrane{.by = 0.1}, ReleaseCrane{}, AttachCrane{}, ClampBase{.on = true},
           ClampBase{.on = false}, ResetRobot{}}) {
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
  EXPECT_FALSE(emulator_->status().clamped);
  EXPECT_TRUE(emulator_->status().crane_attached);
}

TEST_F(OrdersTest, LowerTheRobotToTheGround) {
  StartAs("hanging");
  Order(LowerCrane{.by = 0.2});
  Tick(3000);
  EXPECT_NEAR(Height(), 0.8, 0.005);
  EXPECT_NEAR(emulator_->status().crane_length, config_.crane.length + 0.2, 1e-9);
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
  EXPECT_EQ(emulator_->status().crane_tension, 0);
  EXPECT_FALSE(emulator_->status().crane_attached);
}

TEST_F(OrdersTest, CatchAFallingRobot) {
  StartAs("hanging");
  Order(ReleaseCrane{});
  Tick(200);
  Order(AttachCrane{});
  Tick(3000);
  EXPECT_NEAR(Height(), 0.8, 0.1);
  EXPECT_NEAR(emulator_->status().crane_tension, 60, 1);
}

TEST_F(OrdersTest, ClampTheBaseWhereItIs) {
  StartAs("hanging");
  Order(ReleaseCrane{});
  Tick(200);
  Order(ClampBase{.on = true});
  Tick(1000);
  EXPECT_NEAR(Height(), 0.8, 0.02);
  EXPECT_NEAR(emulator_->world().base().v_WB_W.norm(), 0, 1e-3);
  Order(ClampBase{.on = false});
  Tick(200);
  EXPECT_LT(Height(), 0.7);
}

TEST_F(OrdersTest, ResetTheRobotWhileTimeGoesOn) {
  StartAs("hanging");
  Order(ReleaseCrane{});
  port_.Send(Torque(1));
  Tick(300);
  ASSERT_EQ(emulator_->status().gate, GateState::kDamping);
  Order(ResetRobot{});
  Tick();
  EXPECT_EQ(Height(), 1);
  EXPECT_TRUE(emulator_->status().crane_attached);
  EXPECT_EQ(emulator_->status().gate, GateState::kStart);
  EXPECT_EQ(emulator_->status().commands.accepted, 1U);
  EXPECT_EQ(emulator_->step(), 301);
  EXPECT_EQ(port_.last().state.tick_ms, 300);
}

}  // namespace
}  // namespace understudy
