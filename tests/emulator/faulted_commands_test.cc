// Commands that faults of topics, buses, gears and encoders lose, change, delay or misplace.
#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "robot/refusal.h"
#include "tests/emulator/emulator_test.h"

namespace understudy::emulator {
namespace {

constexpr std::size_t kJoint = 1;

using FaultedCommandsTest = EmulatorTest;

TEST_F(FaultedCommandsTest, DoNotArriveWhereTheirTopicIsOff) {
  StartAs("clamped");
  port_.SendEveryTick(Torque(1));
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "off"}});
  Tick(5);
  EXPECT_EQ(world_->status(0).commands.accepted, 0U);
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "none"}});
  Tick(5);
  EXPECT_EQ(world_->status(0).commands.accepted, 5U);
}

TEST_F(FaultedCommandsTest, ArriveTwiceWhereTheirTopicDoubles) {
  StartAs("clamped");
  port_.SendEveryTick(Torque(1));
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "doubled"}, {"by", 1}});
  Tick(5);
  EXPECT_EQ(world_->status(0).commands.accepted, 10U);
}

TEST_F(FaultedCommandsTest, AreRefusedForTheirCrcWhereTheirTopicDamagesThem) {
  StartAs("clamped");
  port_.SendEveryTick(Torque(1));
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "damaged"}, {"by", 1}});
  Tick(5);
  EXPECT_EQ(world_->status(0).commands.accepted, 0U);
  EXPECT_EQ(world_->status(0).commands.refused[static_cast<std::size_t>(robot::Refusal::kCrc)], 5U);
}

TEST_F(FaultedCommandsTest, ComeAfterTheNextWhereTheirTopicReordersThem) {
  StartAs("clamped");
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "reordered"}, {"by", 1}});
  Tick();
  port_.Send(Torque(1));
  Tick();
  EXPECT_EQ(world_->status(0).commands.accepted, 0U);
  port_.Send(Torque(2));
  Tick();
  EXPECT_EQ(world_->status(0).commands.accepted, 2U);
  EXPECT_EQ(robot().torque()[0], 1);  // of the first, which came last
}

TEST_F(FaultedCommandsTest, AreLostWhereTheyAreOvertakenTooLate) {
  StartAs("clamped");
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "reordered"}, {"by", 1}});
  Tick();
  port_.Send(Torque(1));
  Tick(200);
  port_.Send(Torque(2));
  Tick();
  EXPECT_EQ(world_->status(0).commands.accepted, 1U);
  EXPECT_EQ(robot().torque()[0], 2);
}

TEST_F(FaultedCommandsTest, ComeLaterInTheirOrderWhereTheirTopicDelaysThem) {
  StartAs("clamped");
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "delayed"}, {"by", 0.003}});
  Tick();
  port_.Send(Torque(1));
  Tick();
  port_.Send(Torque(2));
  Tick(2);
  EXPECT_EQ(world_->status(0).commands.accepted, 0U);
  Tick();
  EXPECT_EQ(robot().torque()[0], 1);
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "none"}});
  Tick();
  EXPECT_EQ(robot().torque()[0], 2);
  port_.Send(Torque(3));
  Tick();
  EXPECT_EQ(robot().torque()[0], 3);  // at once again
  EXPECT_EQ(world_->status(0).commands.accepted, 3U);
}

TEST_F(FaultedCommandsTest, DoNotOvertakeThoseThatAreUnderWay) {
  StartAs("clamped");
  Ask("fault", {{"component", "rt/lowcmd"}, {"fault", "delayed"}, {"by", 0.01}, {"for", 0.002}});
  Tick();
  port_.Send(Torque(1));
  Tick(3);  // the fault is over
  port_.Send(Torque(2));
  Tick(5);
  EXPECT_EQ(world_->status(0).commands.accepted, 0U);
  Tick(5);
  EXPECT_EQ(world_->status(0).commands.accepted, 2U);
  EXPECT_EQ(robot().torque()[0], 2);
}

TEST_F(FaultedCommandsTest, ComeToTheMotorsOfASlowBusLaterAndToOthersAtOnce) {
  config_.robots[0].spec.buses = {
      {.name = "leg", .slots = {config_.robots[0].spec.motors[0].slot}}};
  StartAs("clamped");
  Ask("fault", {{"component", "bus.leg"}, {"fault", "slow"}, {"by", 0.005}});
  port_.Send(Torque(1));
  Tick(6);
  port_.Send(Torque(2));
  Tick(5);
  EXPECT_EQ(robot().torque()[0], 1);
  EXPECT_EQ(robot().torque()[1], 2);
  Tick();
  EXPECT_EQ(robot().torque()[0], 2);
}

TEST_F(FaultedCommandsTest, TakeLongerOnABusByItsOwnDelay) {
  config_.robots[0].spec.buses = {
      {.name = "leg", .slots = {config_.robots[0].spec.motors[0].slot}, .delay = {0.004, 0.004}}};
  StartAs("clamped");
  port_.Send(Torque(3));
  Tick(4);
  EXPECT_NE(robot().torque()[0], 3);
  EXPECT_EQ(robot().torque()[1], 3);
  Tick();
  EXPECT_EQ(robot().torque()[0], 3);
}

// The encoder sits on the motor's shaft, which turns before the joint does.
TEST_F(FaultedCommandsTest, MoveTheShaftThroughThePlayOfItsGearBeforeTheJoint) {
  config_.robots[0].spec.dynamics.backlash = 0.02;
  StartAs("clamped");
  const auto ahead = [this] {
    const robot::RobotState& state = port_.last().state;
    return state.motors[kJoint].q - state.truth.q[kJoint];
  };
  port_.SendEveryTick(Torque(5));
  Tick(100);
  EXPECT_NEAR(ahead(), 0.01, 1e-3);
  port_.SendEveryTick(Torque(-5));
  Tick(100);
  EXPECT_NEAR(ahead(), -0.01, 1e-3);
}

// A drive closes its loop over its own encoder.
TEST_F(FaultedCommandsTest, MoveTheJointByTheOffsetOfItsEncoder) {
  config_.robots[0].sensors.noise = false;
  StartAs("clamped");
  robot::RobotCommand hold = Torque(0);
  for (robot::MotorCommand& motor : hold.motors) motor.kp = 200, motor.kd = 5;
  port_.SendEveryTick(hold);
  Tick(1000);
  const double before = world_->physics().robot().q()[kJoint];
  Ask("fault", {{"component", config_.robots[0].spec.motors[kJoint].joint + ".encoder"},
                {"fault", "offset"},
                {"by", 0.1}});
  Tick(1000);
  EXPECT_NEAR(world_->physics().robot().q()[kJoint] - before, -0.1, 0.02);
}

}  // namespace
}  // namespace understudy::emulator
