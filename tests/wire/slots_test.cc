#include "wire/slots.h"

#include <gmock/gmock.h>

#include "base/errors.h"
#include "idl/unitree_go.h"
#include "tests/wire/robots.h"

namespace understudy::wire {
namespace {

using Message = unitree_go_msg_dds__LowCmd_;

TEST(SlotsTest, AcceptARobotThatFits) {
  EXPECT_NO_THROW(CheckFits(GoRobot(), kGoMotorSlots, kGoCells));
  EXPECT_NO_THROW(CheckFits(HgRobot(), kHgMotorSlots, kHgCells));
}

TEST(SlotsTest, RefuseAMotorBeyondTheLast) {
  robot::RobotSpec spec = GoRobot();
  spec.motors[2].slot = 20;
  EXPECT_THROW(CheckFits(spec, kGoMotorSlots, kGoCells), ModelError);
}

TEST(SlotsTest, RefuseMotorsOutOfOrder) {
  robot::RobotSpec spec = GoRobot();
  spec.motors[1].slot = 0;
  EXPECT_THROW(CheckFits(spec, kGoMotorSlots, kGoCells), ModelError);
}

TEST(SlotsTest, RefuseTwoMotorsInOneSlot) {
  robot::RobotSpec spec = GoRobot();
  spec.motors[1].slot = spec.motors[0].slot;
  EXPECT_THROW(CheckFits(spec, kGoMotorSlots, kGoCells), ModelError);
}

TEST(SlotsTest, RefuseANegativeSlot) {
  robot::RobotSpec spec = GoRobot();
  spec.motors[0].slot = -1;
  EXPECT_THROW(CheckFits(spec, kGoMotorSlots, kGoCells), ModelError);
}

TEST(SlotsTest, RefuseABatteryOfTooManyCells) {
  robot::RobotSpec spec = GoRobot();
  spec.battery.cells = 16;
  EXPECT_THROW(CheckFits(spec, kGoMotorSlots, kGoCells), ModelError);
}

TEST(SlotsTest, RefuseABatteryWithoutCells) {
  robot::RobotSpec spec = GoRobot();
  spec.battery.cells = 0;
  EXPECT_THROW(CheckFits(spec, kGoMotorSlots, kGoCells), ModelError);
}

TEST(UnusedSlotCommandsTest, AreNoneInAnEmptyMessage) {
  const UnusedSlots unused = UnusedSlotCommands(Message{}, GoRobot());
  EXPECT_EQ(unused.count, 0);
  EXPECT_FALSE(unused.differ);
}

TEST(UnusedSlotCommandsTest, DoNotCountSlotsWithAMotor) {
  Message message{};
  for (const robot::MotorSpec& motor : GoRobot().motors) message.motor_cmd[motor.slot].kp = 1;
  EXPECT_EQ(UnusedSlotCommands(message, GoRobot()).count, 0);
}

TEST(UnusedSlotCommandsTest, CountGainsAndTorqueButNotModePositionAndRate) {
  Message message{};
  message.motor_cmd[0].kp = 1;
  message.motor_cmd[2].kd = 1;
  message.motor_cmd[18].tau = -1;
  message.motor_cmd[5].mode = 1;
  message.motor_cmd[6].q = 2.146e9F;
  message.motor_cmd[7].dq = 16000;
  EXPECT_EQ(UnusedSlotCommands(message, GoRobot()).count, 3);
}

TEST(UnusedSlotCommandsTest, DoNotDifferInAMessageThatFillsAllSlotsAlike) {
  Message message{};
  for (auto& motor : message.motor_cmd) {
    motor.q = 0.1F;
    motor.kp = 60;
  }
  for (const robot::MotorSpec& motor : GoRobot().motors) message.motor_cmd[motor.slot].q = 0.7F;
  const UnusedSlots unused = UnusedSlotCommands(message, GoRobot());
  EXPECT_EQ(unused.count, kGoMotorSlots - GoRobot().motors.size());
  EXPECT_FALSE(unused.differ);
}

TEST(UnusedSlotCommandsTest, DifferWhereOneIsMeantForAMotor) {
  Message message{};
  message.motor_cmd[18].kp = 60;
  EXPECT_TRUE(UnusedSlotCommands(message, GoRobot()).differ);
  for (auto& motor : message.motor_cmd) motor.kp = 60;
  message.motor_cmd[18].q = 0.3F;
  EXPECT_TRUE(UnusedSlotCommands(message, GoRobot()).differ);
}

}  // namespace
}  // namespace understudy::wire
