#include "wire/go_codec.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/wire/go_command.h"
#include "tests/wire/robots.h"
#include "wire/message_crc.h"

namespace understudy::wire {
namespace {

using LowCmd = unitree_go_msg_dds__LowCmd_;
using LowState = unitree_go_msg_dds__LowState_;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatEq;

robot::Refusal DecodeSealed(LowCmd message, robot::RobotCommand* command) {
  message.crc = MessageCrc(message);
  return Decode(message, GoRobot(), command);
}

robot::Refusal DecodeSealed(const LowCmd& message) {
  robot::RobotCommand command = CommandOf(GoRobot());
  return DecodeSealed(message, &command);
}

TEST(GoDecodeTest, TakesTheSlotsInMotorOrder) {
  LowCmd message = InitialGoCommand();
  message.motor_cmd[1] = {.mode = 1, .q = 1, .dq = 2, .tau = 3, .kp = 4, .kd = 5, .reserve = {}};
  message.motor_cmd[4].q = 6;
  message.motor_cmd[19].q = 7;
  robot::RobotCommand command = CommandOf(GoRobot());
  ASSERT_EQ(DecodeSealed(message, &command), robot::Refusal::kNone);
  EXPECT_EQ(command.motors[0],
            (robot::MotorCommand{.enabled = true, .q = 1, .dq = 2, .tau = 3, .kp = 4, .kd = 5}));
  EXPECT_EQ(command.motors[1].q, 6);
  EXPECT_EQ(command.motors[2].q, 7);
}

TEST(GoDecodeTest, PassesTheMarksForNoPositionAndNoVelocityExactly) {
  robot::RobotCommand command = CommandOf(GoRobot());
  ASSERT_EQ(DecodeSealed(InitialGoCommand(), &command), robot::Refusal::kNone);
  for (const robot::MotorCommand& motor : command.motors) {
    EXPECT_EQ(motor.q, robot::kNoPosition);
    EXPECT_EQ(motor.dq, robot::kNoVelocity);
  }
}

TEST(GoDecodeTest, KnowsStopServoAndStrongServo) {
  LowCmd message = InitialGoCommand();
  message.motor_cmd[1].mode = 0;
  message.motor_cmd[4].mode = 1;
  message.motor_cmd[19].mode = 0x0A;
  robot::RobotCommand command = CommandOf(GoRobot());
  ASSERT_EQ(DecodeSealed(message, &command), robot::Refusal::kNone);
  EXPECT_FALSE(command.motors[0].enabled);
  EXPECT_TRUE(command.motors[1].enabled);
  EXPECT_TRUE(command.motors[2].enabled);
}

TEST(GoDecodeTest, RefusesAnAllZeroMessageForItsCrc) {
  robot::RobotCommand command = CommandOf(GoRobot());
  EXPECT_EQ(Decode(LowCmd{}, GoRobot(), &command), robot::Refusal::kCrc);
}

TEST(GoDecodeTest, RefusesAWrongCrcBeforeAllElse) {
  robot::RobotCommand command = CommandOf(GoRobot());
  LowCmd message{};
  message.motor_cmd[1].mode = 9;
  message.crc = MessageCrc(message) ^ 1;
  EXPECT_EQ(Decode(message, GoRobot(), &command), robot::Refusal::kCrc);
}

TEST(GoDecodeTest, RefusesAWrongHead) {
  for (const int byte : {0, 1}) {
    LowCmd message = InitialGoCommand();
    message.head[byte] ^= 1;
    message.motor_cmd[1].mode = 9;
    EXPECT_EQ(DecodeSealed(message), robot::Refusal::kHead);
  }
}

TEST(GoDecodeTest, TakesAHeadThatWasNeverSet) {
  LowCmd message = InitialGoCommand();
  message.head[0] = 0;
  message.head[1] = 0;
  EXPECT_EQ(DecodeSealed(message), robot::Refusal::kHead);
  message.level_flag = 0;
  EXPECT_EQ(DecodeSealed(message), robot::Refusal::kNone);
}

TEST(GoDecodeTest, RefusesTheLevelFlagOfHighLevel) {
  LowCmd message = InitialGoCommand();
  message.level_flag = 0xEE;
  EXPECT_EQ(DecodeSealed(message), robot::Refusal::kHead);
}

TEST(GoDecodeTest, RefusesAnUnknownModeOfAMotor) {
  LowCmd message = InitialGoCommand();
  message.motor_cmd[19].mode = 2;
  EXPECT_EQ(DecodeSealed(message), robot::Refusal::kMotorMode);
}

TEST(GoDecodeTest, IgnoresTheModeOfASlotWithoutAMotor) {
  LowCmd message = InitialGoCommand();
  message.motor_cmd[0].mode = 2;
  EXPECT_EQ(DecodeSealed(message), robot::Refusal::kNone);
}

TEST(GoDecodeTest, FillsTheCommandEvenWhenItRefuses) {
  LowCmd message = InitialGoCommand();
  message.motor_cmd[4] = {.mode = 2, .q = 1, .dq = 0, .tau = 0, .kp = 20, .kd = 0, .reserve = {}};
  robot::RobotCommand command = CommandOf(GoRobot());
  ASSERT_EQ(Decode(message, GoRobot(), &command), robot::Refusal::kCrc);
  EXPECT_TRUE(command.motors[1].enabled);
  EXPECT_EQ(command.motors[1].kp, 20);
}

LowState EncodeOnce(const robot::RobotState& state) {
  LowState message{};
  Encode(state, GoRobot(), &message);
  return message;
}

TEST(GoEncodeTest, WritesTheHeadARobotWrites) {
  const LowState message = EncodeOnce(StateOf(GoRobot()));
  EXPECT_THAT(message.head, ElementsAre(0xFE, 0xEF));
  EXPECT_EQ(message.level_flag, 0);
  EXPECT_EQ(message.frame_reserve, 0);
  EXPECT_THAT(message.sn, Each(0));
  EXPECT_THAT(message.version, Each(0));
  EXPECT_EQ(message.bandwidth, 0);
  EXPECT_EQ(message.reserve, 0);
}

TEST(GoEncodeTest, ClosesWithTheRightCrc) {
  robot::RobotState state = StateOf(GoRobot());
  state.tick_ms = 77;
  const LowState message = EncodeOnce(state);
  EXPECT_EQ(message.crc, MessageCrc(message));
}

TEST(GoEncodeTest, CountsMillisecondsInTickAndWrapsAround) {
  robot::RobotState state = StateOf(GoRobot());
  state.tick_ms = 5'119'099;
  EXPECT_EQ(EncodeOnce(state).tick, 5'119'099);
  state.tick_ms = (std::int64_t{1} << 32) + 3;
  EXPECT_EQ(EncodeOnce(state).tick, 3);
}

TEST(GoEncodeTest, PutsMotorsIntoTheirSlots) {
  robot::RobotState state = StateOf(GoRobot());
  state.motors[1] = {
      .enabled = false, .q = 0.5, .dq = -2, .tau = 8, .casing_c = 30, .winding_c = 61.7};
  const LowState message = EncodeOnce(state);
  const auto& motor = message.motor_state[4];
  EXPECT_EQ(motor.mode, 1);  // passive motors show 1 too
  EXPECT_EQ(motor.q, 0.5F);
  EXPECT_EQ(motor.dq, -2);
  EXPECT_EQ(motor.tau_est, 8);
  EXPECT_EQ(motor.temperature, 62);
  EXPECT_EQ(motor.ddq, 0);
  EXPECT_EQ(motor.q_raw, 0);
  EXPECT_EQ(motor.lost, 0);
  EXPECT_EQ(motor.reserve[0], 0);
  EXPECT_GE(motor.reserve[1], 523);
  EXPECT_LE(motor.reserve[1], 638);
}

TEST(GoEncodeTest, LeavesSlotsWithoutAMotorZero) {
  robot::RobotState state = StateOf(GoRobot());
  for (robot::MotorReading& motor : state.motors)
    motor = {.q = 1, .dq = 1, .tau = 1, .winding_c = 50};
  const LowState message = EncodeOnce(state);
  for (const int slot : {0, 2, 3, 5, 18}) {
    const auto& motor = message.motor_state[slot];
    EXPECT_EQ(motor.mode, 0);
    EXPECT_EQ(motor.q, 0);
    EXPECT_EQ(motor.temperature, 0);
    EXPECT_EQ(motor.reserve[1], 0);
  }
}

TEST(GoEncodeTest, WritesFeetInCountsWithinTheirRange) {
  robot::RobotState state = StateOf(GoRobot());
  state.foot_force = {40, 1e6};
  const LowState message = EncodeOnce(state);
  EXPECT_THAT(message.foot_force, ElementsAre(35, 4095, 0, 0));
  EXPECT_THAT(message.foot_force_est, Each(0));
}

TEST(GoEncodeTest, WritesTheBatteryAsARealGo2Did) {
  robot::RobotState state = StateOf(GoRobot());
  state.battery = {.voltage = 30.674, .current = -3.627, .soc = 0.63, .temperature_c = 30};
  const LowState message = EncodeOnce(state);
  EXPECT_EQ(message.bms_state.status, 8);
  EXPECT_EQ(message.bms_state.soc, 63);
  EXPECT_EQ(message.bms_state.current, -3627);
  EXPECT_THAT(message.bms_state.bq_ntc, Each(30));
  for (int cell = 0; cell < 15; ++cell) {
    EXPECT_EQ(message.bms_state.cell_vol[cell], cell < 8 ? 3834 : 0);
  }
  EXPECT_NEAR(message.power_v, 29.544, 0.2);
  EXPECT_NEAR(message.power_a, 2.51, 0.02);
}

TEST(GoEncodeTest, WritesEachCellWithItsOwnVoltage) {
  robot::RobotState state = StateOf(GoRobot());
  state.battery.voltage = 32;
  state.battery.cell_off_v[0] = -0.007;
  state.battery.cell_off_v[3] = 0.002;
  const LowState message = EncodeOnce(state);
  EXPECT_EQ(message.bms_state.cell_vol[0], 3993);
  EXPECT_EQ(message.bms_state.cell_vol[1], 4000);
  EXPECT_EQ(message.bms_state.cell_vol[3], 4002);
}

TEST(GoEncodeTest, TellsAMotorWhoseBusHasTooLittleVoltage) {
  robot::RobotState state = StateOf(GoRobot());
  state.motors[0].undervoltage = true;
  const LowState message = EncodeOnce(state);
  EXPECT_EQ(message.motor_state[GoRobot().motors[0].slot].reserve[0], 0x08U);
  EXPECT_EQ(message.motor_state[GoRobot().motors[1].slot].reserve[0], 0U);
}

TEST(GoEncodeTest, TellsThatNoRemoteIsThere) {
  robot::RobotState state = StateOf(GoRobot());
  EXPECT_EQ(EncodeOnce(state).bit_flag, 0x24);
  state.remote = {.there = true, .keys = 9};
  const LowState message = EncodeOnce(state);
  EXPECT_EQ(message.bit_flag, 0x04);
  EXPECT_EQ(message.wireless_remote[0], 0x55);
  EXPECT_EQ(message.wireless_remote[2], 9);
}

TEST(GoEncodeTest, TellsOfFansAndOfASilentController) {
  robot::RobotState state = StateOf(GoRobot());
  state.board = {.fan_rpm = {1000, 2000.4, 0}, .stalled = 4, .mute = true};
  const LowState message = EncodeOnce(state);
  EXPECT_THAT(message.fan_frequency, ElementsAre(1000, 2000, 0, 4));
  EXPECT_EQ(message.bit_flag, 0x64);
}

TEST(GoEncodeTest, WritesTheBoardAsARealGo2Did) {
  robot::RobotState state = StateOf(GoRobot());
  state.board = {.centre_c = 45, .charger_c = 41};
  const LowState message = EncodeOnce(state);
  EXPECT_THAT(message.adc_reel, FloatEq(0.0064453125F));
  EXPECT_EQ(message.temperature_ntc1, 45);
  EXPECT_EQ(message.temperature_ntc2, 41);
  EXPECT_THAT(message.fan_frequency, Each(0));
}

}  // namespace
}  // namespace understudy::wire
