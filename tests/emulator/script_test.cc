#include "base/errors.h"
#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

class ScriptTest : public EmulatorTest {};

TEST_F(ScriptTest, GivesEachOrderToTheTickOfItsTime) {
  config_.robot.rates.lowstate_hz = 1000;
  StartAs("standing");
  world_->Play({{.at = 0.3, .order = ClampBase{}, .where = ""},
                {.at = 0.5, .order = ClampBase{.on = false}, .where = ""}});
  Tick(300);
  EXPECT_FALSE(world_->status().clamped);
  Tick();
  EXPECT_TRUE(world_->status().clamped);
  EXPECT_EQ(world_->status().script_done, 1U);
  Tick(200);
  EXPECT_FALSE(world_->status().clamped);
  EXPECT_EQ(world_->status().script_done, 2U);
}

TEST_F(ScriptTest, CountsWhatTheRobotRefusesAndSaysWhere) {
  StartAs("standing");
  world_->Play({{.at = 0, .order = LowerCrane{.by = 1}, .where = "s.yaml:3"}});
  Tick();
  EXPECT_EQ(world_->status().script_refused, 1U);
  EXPECT_STREQ(world_->status().script_refusal.data(),
               "s.yaml:3: the robot does not hang from the crane");
}

TEST_F(ScriptTest, RefusesABodyThatTheModelDoesNotHave) {
  Start();
  EXPECT_THROW(world_->Play({{.at = 0, .order = PushBody{.body = "tail"}, .where = "s:1"}}),
               ConfigError);
}

class PushTest : public EmulatorTest {
 protected:
  // Upward speed of a falling robot of 6 kg after so many ticks, pushed up by 60 N from the first.
  double SpeedAfter(int ticks, double seconds) {
    config_.start.pose = "hanging";
    Start();
    Order(ReleaseCrane{});
    Order(PushBody{.body = "", .force = {0, 0, 60}, .seconds = seconds});
    Tick(ticks);
    return world_->physics().base().v_WB_W.z();
  }
};

TEST_F(PushTest, GivesTheRobotItsImpulse) {
  EXPECT_NEAR(SpeedAfter(150, 0.1), -10 * 0.15 + 60 * 0.1 / 6, 0.02);
}

TEST_F(PushTest, LastsAsLongAsItIsTold) {
  const double short_push = SpeedAfter(40, 0.01);
  EXPECT_NEAR(SpeedAfter(40, 0.02) - short_push, 60 * 0.01 / 6, 0.01);
}

TEST_F(PushTest, OfABodyThatIsNotThereIsRefused) {
  Start();
  auto answer = inbox_.Put(PushBody{.body = "tail", .seconds = 1}, Inbox::WallTime::max());
  Tick();
  EXPECT_EQ(answer->get(), "the model has no body 'tail'");
}

TEST_F(PushTest, EndsWithAReset) {
  config_.start.pose = "clamped";
  Start();
  Order(PushBody{.body = "", .force = {60, 0, 0}, .seconds = 100});
  Order(ResetRobot{});
  Order(ClampBase{.on = false});
  Tick(100);
  EXPECT_NEAR(world_->physics().base().v_WB_W.x(), 0, 1e-6);
}

}  // namespace
}  // namespace understudy::emulator
