#include "wire/hg_codec.h"

#include <gmock/gmock.h>

#include "tests/wire/robots.h"
#include "wire/message_crc.h"

namespace understudy::wire {
namespace {

using Bms = unitree_hg_msg_dds__BmsState_;
using LowCmd = unitree_hg_msg_dds__LowCmd_;
using LowState = unitree_hg_msg_dds__LowState_;
using ::testing::Each;
using ::testing::ElementsAre;

LowCmd Enabled() {
  LowCmd message{};
  message.mode_machine = 5;
  for (const robot::MotorSpec& motor : HgRobot().motors) message.motor_cmd[motor.slot].mode = 1;
  return message;
}

robot::Refusal DecodeSealed(LowCmd message, robot::RobotCommand* command) {
  message.crc = MessageCrc(message);
  return Decode(message, HgRobot(), command);
}

robot::Refusal DecodeSealed(const LowCmd& message) {
  robot::RobotCommand command = CommandOf(HgRobot());
  return DecodeSealed(message, &command);
}

TEST(HgDecodeTest, TakesTheSlotsInMotorOrder) {
  LowCmd message = Enabled();
  message.motor_cmd[2] = {.mode = 1, .q = 1, .dq = 2, .tau = 3, .kp = 4, .kd = 5, .reserve = 0};
  message.motor_cmd[34].q = 6;
  robot::RobotCommand command = CommandOf(HgRobot());
  ASSERT_EQ(DecodeSealed(message, &command), robot::Refusal::kNone);
  EXPECT_EQ(command.motors[0],
            (robot::MotorCommand{.enabled = true, .q = 1, .dq = 2, .tau = 3, .kp = 4, .kd = 5}));
  EXPECT_EQ(command.motors[3].q, 6);
}

TEST(HgDecodeTest, TakesBothJointSpaces) {
  LowCmd message = Enabled();
  robot::RobotCommand command = CommandOf(HgRobot());
  ASSERT_EQ(DecodeSealed(message, &command), robot::Refusal::kNone);
  for (const auto& motor : command.motors) EXPECT_EQ(motor.space, robot::JointSpace::kPitchRoll);
  message.mode_pr = 1;
  ASSERT_EQ(DecodeSealed(message, &command), robot::Refusal::kNone);
  for (const auto& motor : command.motors) EXPECT_EQ(motor.space, robot::JointSpace::kMotors);
}

TEST(HgDecodeTest, TakesADisabledMotor) {
  LowCmd message = Enabled();
  message.motor_cmd[7].mode = 0;
  robot::RobotCommand command = CommandOf(HgRobot());
  ASSERT_EQ(DecodeSealed(message, &command), robot::Refusal::kNone);
  EXPECT_FALSE(command.motors[2].enabled);
}

TEST(HgDecodeTest, RefusesAnAllZeroMessageForItsCrc) {
  robot::RobotCommand command = CommandOf(HgRobot());
  EXPECT_EQ(Decode(LowCmd{}, HgRobot(), &command), robot::Refusal::kCrc);
}

TEST(HgDecodeTest, RefusesAWrongCrcBeforeAllElse) {
  robot::RobotCommand command = CommandOf(HgRobot());
  LowCmd message = Enabled();
  message.mode_machine = 6;
  message.crc = MessageCrc(message) ^ 1;
  EXPECT_EQ(Decode(message, HgRobot(), &command), robot::Refusal::kCrc);
}

TEST(HgDecodeTest, RefusesWrongModeMachine) {
  LowCmd message = Enabled();
  message.mode_machine = 0;
  message.mode_pr = 2;
  EXPECT_EQ(DecodeSealed(message), robot::Refusal::kModeMachine);
}

TEST(HgDecodeTest, RefusesAnUnknownModePr) {
  LowCmd message = Enabled();
  message.mode_pr = 2;
  message.motor_cmd[2].mode = 2;
  EXPECT_EQ(DecodeSealed(message), robot::Refusal::kModePr);
}

TEST(HgDecodeTest, RefusesAnUnknownModeOfAMotor) {
  LowCmd message = Enabled();
  message.motor_cmd[34].mode = 0x0A;
  EXPECT_EQ(DecodeSealed(message), robot::Refusal::kMotorMode);
}

TEST(HgDecodeTest, IgnoresTheModeOfASlotWithoutAMotor) {
  LowCmd message = Enabled();
  message.motor_cmd[0].mode = 0x0A;
  EXPECT_EQ(DecodeSealed(message), robot::Refusal::kNone);
}

LowState EncodeOnce(const robot::RobotState& state) {
  LowState message{};
  Encode(state, HgRobot(), &message);
  return message;
}

TEST(HgEncodeTest, WritesWhatARealG1Showed) {
  robot::RobotState state = StateOf(HgRobot());
  state.tick_ms = 42;
  const LowState message = EncodeOnce(state);
  EXPECT_THAT(message.version, Each(0));
  EXPECT_EQ(message.mode_pr, 0);
  EXPECT_EQ(message.mode_machine, 5);
  EXPECT_EQ(message.tick, 42);
  EXPECT_THAT(message.reserve, Each(0));
  EXPECT_THAT(message.wireless_remote, Each(0));
  EXPECT_EQ(message.crc, MessageCrc(message));
}

TEST(HgEncodeTest, PutsMotorsIntoTheirSlots) {
  robot::RobotState state = StateOf(HgRobot());
  state.battery.voltage = 47.8;
  state.motors[3] = {.q = 0.5, .dq = -2, .tau = 8, .casing_c = 31.4, .winding_c = -3};
  const LowState message = EncodeOnce(state);
  const auto& motor = message.motor_state[34];
  EXPECT_EQ(motor.mode, 1);
  EXPECT_EQ(motor.q, 0.5F);
  EXPECT_EQ(motor.dq, -2);
  EXPECT_EQ(motor.ddq, 0);
  EXPECT_EQ(motor.tau_est, 8);
  EXPECT_THAT(motor.temperature, ElementsAre(31, -3));
  EXPECT_EQ(motor.vol, 48);
  EXPECT_EQ(motor.motorstate, 0);
}

TEST(HgEncodeTest, LeavesSlotsWithoutAMotorZero) {
  robot::RobotState state = StateOf(HgRobot());
  state.battery.voltage = 48;
  for (robot::MotorReading& motor : state.motors) motor.q = 1;
  const LowState message = EncodeOnce(state);
  for (const int slot : {0, 1, 3, 5, 6, 33}) {
    EXPECT_EQ(message.motor_state[slot].mode, 0);
    EXPECT_EQ(message.motor_state[slot].q, 0);
    EXPECT_EQ(message.motor_state[slot].vol, 0);
  }
}

// ratio 0.5, pitch 1 and roll 0.5: A = 1 + 0.25, B = 1 - 0.25. Torques: pitch 4, roll 1 make
// A = (4 + 2) / 2, B = (4 - 2) / 2.
TEST(HgEncodeTest, ShowsMotorBInThePitchSlotAndAInTheRollSlot) {
  robot::RobotState state = StateOf(HgRobot());
  state.joint_space = robot::JointSpace::kMotors;
  state.motors[1] = {.q = 0.5, .dq = 5, .tau = 1};
  state.motors[2] = {.q = 1, .dq = 10, .tau = 4};
  const LowState message = EncodeOnce(state);
  EXPECT_EQ(message.mode_pr, 1);
  const auto& a = message.motor_state[4];
  const auto& b = message.motor_state[7];
  EXPECT_EQ(a.q, 1.25F);
  EXPECT_EQ(b.q, 0.75F);
  EXPECT_EQ(a.dq, 12.5F);
  EXPECT_EQ(b.dq, 7.5F);
  EXPECT_EQ(a.tau_est, 3);
  EXPECT_EQ(b.tau_est, 1);
}

TEST(HgEncodeTest, ShowsTheSerialJointsInPitchRoll) {
  robot::RobotState state = StateOf(HgRobot());
  state.motors[1].q = 0.5;
  state.motors[2].q = 1;
  const LowState message = EncodeOnce(state);
  EXPECT_EQ(message.motor_state[4].q, 0.5F);
  EXPECT_EQ(message.motor_state[7].q, 1);
}

TEST(HgEncodeTest, PassesTheRemote) {
  robot::RobotState state = StateOf(HgRobot());
  state.remote = {.there = true, .keys = 9};
  EXPECT_EQ(EncodeOnce(state).wireless_remote[2], 9);
}

TEST(HgEncodeTest, TellsWarmMotorsAndABusWithoutVoltage) {
  robot::RobotState state = StateOf(HgRobot());
  state.motors[3].warm = true;
  state.motors[2].undervoltage = true;
  const LowState message = EncodeOnce(state);
  const robot::RobotSpec spec = HgRobot();
  EXPECT_EQ(message.motor_state[spec.motors[3].slot].motorstate, 0x10000000U);
  EXPECT_EQ(message.motor_state[spec.motors[2].slot].motorstate, 0x8U);
}

TEST(HgBmsTest, WritesCellsPackAndCharge) {
  robot::RobotState state = StateOf(HgRobot());
  state.battery = {.voltage = 52, .current = -2.1, .soc = 0.805, .temperature_c = 28};
  Bms message{};
  EncodeBms(state, HgRobot(), &message);
  for (int cell = 0; cell < 40; ++cell) EXPECT_EQ(message.cell_vol[cell], cell < 13 ? 4000 : 0);
  EXPECT_THAT(message.bmsvoltage, ElementsAre(52000, 52000, 0));
  EXPECT_EQ(message.version_high, 1);
  EXPECT_EQ(message.version_low, 6);
  EXPECT_EQ(message.fn, 5);
  EXPECT_EQ(message.current, -2100);
  EXPECT_EQ(message.soc, 81);
  EXPECT_THAT(message.temperature, Each(28));
}

}  // namespace
}  // namespace understudy::wire
