#include "wire/hand_codec.h"

#include <array>

#include <gtest/gtest.h>

namespace understudy::wire {
namespace {

robot::HandSpec ThreeMotors() {
  return {.name = "left",
          .motors = {{.joint = "a"}, {.joint = "b"}, {.joint = "c"}},
          .pads = {{.taxels = {3, 11}}, {.taxels = {}}},
          .temperature_c = 40,
          .supply_v = 24};
}

// Modes as g1_dex3_example packs them: id, 1 << 4 to follow, 1 << 7 to be watched.
class HandDecodeTest : public testing::Test {
 protected:
  HandDecodeTest() {
    for (std::size_t i = 0; i < wire_.size(); ++i) {
      wire_[i].mode = static_cast<std::uint8_t>(i | 1 << 4);
    }
  }

  robot::Refusal Read(std::size_t length = 3) {
    unitree_hg_msg_dds__HandCmd_ message{};
    message.motor_cmd._length = static_cast<std::uint32_t>(length);
    message.motor_cmd._buffer = wire_.data();
    return Decode(message, spec_, &command_);
  }

  const robot::HandSpec spec_ = ThreeMotors();
  std::array<unitree_hg_msg_dds__MotorCmd_, 4> wire_{};
  robot::RobotCommand command_;
};

TEST_F(HandDecodeTest, ReadsEveryFieldOfEveryMotor) {
  wire_[2] = {.mode = 2 | 1 << 4, .q = 1, .dq = 2, .tau = 3, .kp = 4, .kd = 5, .reserve = 9};
  EXPECT_EQ(Read(), robot::Refusal::kNone);
  ASSERT_EQ(command_.motors.size(), 3U);
  EXPECT_EQ(command_.motors[2],
            (robot::MotorCommand{.enabled = true, .q = 1, .dq = 2, .tau = 3, .kp = 4, .kd = 5}));
  EXPECT_FALSE(command_.motors[2].watched);
  EXPECT_EQ(command_.motors[0], robot::MotorCommand{.enabled = true});
}

TEST_F(HandDecodeTest, StatusZeroLocks) {
  wire_[1].mode = 1;
  EXPECT_EQ(Read(), robot::Refusal::kNone);
  EXPECT_FALSE(command_.motors[1].enabled);
  EXPECT_TRUE(command_.motors[0].enabled);
}

TEST_F(HandDecodeTest, TheHighestBitHasAMotorWatched) {
  wire_[1].mode = 1 | 1 << 4 | 1 << 7;
  EXPECT_EQ(Read(), robot::Refusal::kNone);
  EXPECT_TRUE(command_.motors[1].watched);
  EXPECT_TRUE(command_.motors[1].enabled);
  EXPECT_FALSE(command_.motors[2].watched);
}

TEST_F(HandDecodeTest, RefusesAnIdThatIsNotThePlace) {
  wire_[1].mode = 2 | 1 << 4;
  EXPECT_EQ(Read(), robot::Refusal::kMotorMode);
  EXPECT_TRUE(command_.motors[1].enabled);  // for a lenient gate
}

// What other hg programs put into mode.
TEST_F(HandDecodeTest, RefusesAOneInEveryMode) {
  for (auto& motor : wire_) motor.mode = 1;
  EXPECT_EQ(Read(), robot::Refusal::kMotorMode);
}

TEST_F(HandDecodeTest, RefusesAnUnknownStatus) {
  for (const int status : {2, 3, 4, 5, 6, 7}) {
    wire_[0].mode = static_cast<std::uint8_t>(status << 4);
    EXPECT_EQ(Read(), robot::Refusal::kMotorMode) << status;
    EXPECT_TRUE(command_.motors[0].enabled);
  }
}

TEST_F(HandDecodeTest, RefusesAnotherNumberOfMotorsAndLeavesTheCommandAlone) {
  ASSERT_EQ(Read(), robot::Refusal::kNone);
  wire_[0].q = 7;
  for (const std::size_t length : {0U, 2U, 4U})
    EXPECT_EQ(Read(length), robot::Refusal::kMotorCount);
  EXPECT_EQ(command_.motors.size(), 3U);
  EXPECT_EQ(command_.motors[0].q, 0);
}

TEST_F(HandDecodeTest, RefusesAMessageWithoutASequence) {
  const unitree_hg_msg_dds__HandCmd_ message{};
  EXPECT_EQ(Decode(message, spec_, &command_), robot::Refusal::kMotorCount);
}

class HandStateTest : public testing::Test {
 protected:
  const robot::HandSpec spec_ = ThreeMotors();
  HandStateMessage message_{spec_};
};

TEST_F(HandStateTest, TellsEveryMotorWithItsMode) {
  message_.Encode(std::array<robot::MotorReading, 3>{
      {{},
       {.enabled = true, .q = 1, .dq = 2, .tau = 3, .casing_c = 40.4, .winding_c = 50.6},
       {.timed_out = true}}});
  const auto& wire = message_.message().motor_state;
  ASSERT_EQ(wire._length, 3U);
  EXPECT_EQ(wire._buffer[0].mode, 0);
  EXPECT_EQ(wire._buffer[1].mode, 1 | 1 << 4);
  EXPECT_EQ(wire._buffer[2].mode, 2 | 1 << 7);
  EXPECT_EQ(wire._buffer[1].q, 1);
  EXPECT_EQ(wire._buffer[1].dq, 2);
  EXPECT_EQ(wire._buffer[1].tau_est, 3);
  EXPECT_EQ(wire._buffer[1].temperature[0], 40);
  EXPECT_EQ(wire._buffer[1].temperature[1], 51);
  EXPECT_EQ(wire._buffer[1].motorstate, 0U);
}

TEST_F(HandStateTest, AnUntouchedPadShowsTheLeastValidValueWhereItHasTaxels) {
  const auto& pads = message_.message().press_sensor_state;
  ASSERT_EQ(pads._length, 2U);
  for (int i = 0; i < 12; ++i) {
    const bool there = i == 3 || i == 11;
    EXPECT_EQ(pads._buffer[0].pressure[i], there ? 100000 : 30000) << i;
    EXPECT_EQ(pads._buffer[0].temperature[i], there ? 40 : 0) << i;
    EXPECT_EQ(pads._buffer[1].pressure[i], 30000) << i;
  }
}

TEST_F(HandStateTest, ShowsItsSupply) { EXPECT_EQ(message_.message().power_v, 24); }

TEST_F(HandStateTest, StaysWholeWhenMoved) {
  HandStateMessage moved = std::move(message_);
  moved.Encode(std::array<robot::MotorReading, 3>{{{.q = 1}, {.q = 2}, {.q = 3}}});
  EXPECT_EQ(moved.message().motor_state._buffer[2].q, 3);
  EXPECT_EQ(moved.message().press_sensor_state._buffer[1].pressure[0], 30000);
}

}  // namespace
}  // namespace understudy::wire
