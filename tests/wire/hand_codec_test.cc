#include "wire/hand_codec.h"

#include <array>
#include <string>

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

TEST_F(HandStateTest, ATouchedTaxelShowsMoreAndThoseThatAreNotThereDoNot) {
  std::vector<float> counts(24);
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = static_cast<float>(i);
  message_.EncodeTouch(counts);
  const auto& pad = message_.message().press_sensor_state._buffer[0];
  EXPECT_EQ(pad.pressure[3], 100003);
  EXPECT_EQ(pad.pressure[11], 100011);
  EXPECT_EQ(pad.pressure[4], 30000);
  message_.EncodeTouch({});
  EXPECT_EQ(message_.message().press_sensor_state._buffer[0].pressure[3], 100003)
      << "no sample yet";
}

TEST_F(HandStateTest, ShowsItsSupply) { EXPECT_EQ(message_.message().power_v, 24); }

TEST_F(HandStateTest, StaysWholeWhenMoved) {
  HandStateMessage moved = std::move(message_);
  moved.Encode(std::array<robot::MotorReading, 3>{{{.q = 1}, {.q = 2}, {.q = 3}}});
  EXPECT_EQ(moved.message().motor_state._buffer[2].q, 3);
  EXPECT_EQ(moved.message().press_sensor_state._buffer[1].pressure[0], 30000);
}

// Two motors in slots 1 and 2 of three, of which q 1 is -0.5 rad and q 0 is 1.5 rad.
robot::HandSpec Spanned(const std::string& law) {
  robot::HandSpec spec{.name = "fingers", .law = law, .slot = 1, .slots = 3};
  for (const char* joint : {"a", "b"}) {
    spec.motors.push_back(
        {.joint = joint, .torque_limit = 4, .knee_speed = 2, .span = {1.5, -0.5}});
  }
  return spec;
}

class MotorListTest : public testing::Test {
 protected:
  unitree_go_msg_dds__MotorCmds_ Message(std::size_t length) {
    unitree_go_msg_dds__MotorCmds_ message{};
    message.cmds._length = static_cast<std::uint32_t>(length);
    message.cmds._buffer = wire_.data();
    return message;
  }
  robot::Refusal Read(const robot::HandSpec& spec, std::size_t length = 3) {
    return Decode(Message(length), spec, &command_);
  }
  static unitree_go_msg_dds__MotorState_ Second(const robot::HandSpec& spec,
                                                const robot::MotorReading& reading) {
    MotorStatesMessage message(spec);
    message.Encode(std::array{robot::MotorReading{}, reading});
    return message.message().states._buffer[static_cast<std::size_t>(spec.slot) + 1];
  }

  std::array<unitree_go_msg_dds__MotorCmd_, 4> wire_{};
  robot::RobotCommand command_;
};

TEST_F(MotorListTest, AGripperFollowsEveryFieldWhateverTheModeAndIsWatched) {
  wire_[0] = {.mode = 0, .q = 1, .dq = 2, .tau = 3, .kp = 4, .kd = 5, .reserve = {}};
  EXPECT_EQ(Read({.law = "dex1", .motors = {{.joint = "jaw"}}}, 1), robot::Refusal::kNone);
  EXPECT_EQ(command_.motors.at(0),
            (robot::MotorCommand{
                .enabled = true, .q = 1, .dq = 2, .tau = 3, .kp = 4, .kd = 5, .watched = true}));
}

TEST_F(MotorListTest, AngleAndSpeedAreSharesOfTheSpanFromTheFirstSlotOn) {
  wire_[1].q = 0.25;
  wire_[1].dq = 0.5;
  wire_[2].q = -1;
  wire_[2].dq = 7;
  EXPECT_EQ(Read(Spanned("brainco")), robot::Refusal::kNone);
  EXPECT_EQ(command_.motors.at(0).q, 1);
  EXPECT_EQ(command_.motors[0].dq, 1);
  EXPECT_EQ(command_.motors.at(1).q, 1.5) << "as 0";
  EXPECT_EQ(command_.motors[1].dq, 2) << "full speed";
}

TEST_F(MotorListTest, RefusesFewerMotorsThanTheServiceReadsAndIgnoresMore) {
  EXPECT_EQ(Read(Spanned("inspire"), 2), robot::Refusal::kMotorCount);
  EXPECT_EQ(Read(Spanned("inspire"), 4), robot::Refusal::kNone);
  EXPECT_EQ(command_.motors.size(), 2U);
}

TEST_F(MotorListTest, HandSdkClosesPositivelyByTheWeightOfItsFirstMode) {
  robot::RobotSpec spec;
  spec.hands = {{.motors = {{.joint = "a"}}, .sdk_slot = 0},
                {.motors = {{.joint = "b"}}},
                {.motors = {{.joint = "c"}}, .sdk_slot = 2}};
  wire_[0].mode = 40;
  wire_[0].q = robot::kNoPosition;
  wire_[0].dq = robot::kNoVelocity;
  wire_[0].tau = 0.5F;
  wire_[2] = {.mode = 9, .q = 1, .dq = -2, .tau = 3, .kp = 4, .kd = 5, .reserve = {}};
  EXPECT_EQ(DecodeHandSdk(Message(3), spec, &command_), robot::Refusal::kMotorCount);
  EXPECT_EQ(DecodeHandSdk(Message(4), spec, &command_), robot::Refusal::kNone);
  EXPECT_EQ(command_.weight, 0.4);
  ASSERT_EQ(command_.motors.size(), 3U);
  EXPECT_EQ(command_.motors[0],
            (robot::MotorCommand{
                .enabled = true, .q = robot::kNoPosition, .dq = robot::kNoVelocity, .tau = -0.5}));
  EXPECT_EQ(command_.motors[1], robot::MotorCommand{});
  EXPECT_EQ(command_.motors[2],
            (robot::MotorCommand{.enabled = true, .q = -1, .dq = 2, .tau = -3, .kp = 4, .kd = 5}));
}

TEST_F(MotorListTest, StatesHaveWhatTheServiceFillsIn) {
  const robot::MotorReading reading{
      .enabled = true, .q = 1, .dq = -1, .tau = 2, .casing_c = 40, .lost = 3};
  const auto jaw = Second({.law = "dex1", .motors = {{.joint = "a"}, {.joint = "b"}}}, reading);
  EXPECT_EQ(jaw.q, 1);
  EXPECT_EQ(jaw.dq, -1);
  EXPECT_EQ(jaw.tau_est, 2);
  EXPECT_EQ(jaw.mode, 0);
  EXPECT_EQ(jaw.temperature, 0);
  EXPECT_EQ(jaw.lost, 0U);
  const auto inspire = Second(Spanned("inspire"), reading);
  EXPECT_EQ(inspire.q, 0.25F);
  EXPECT_EQ(inspire.dq, 0);
  EXPECT_EQ(inspire.tau_est, 0);
  EXPECT_EQ(inspire.lost, 3U);
  const auto brainco = Second(Spanned("brainco"), reading);
  EXPECT_EQ(brainco.q, 0.25F);
  EXPECT_EQ(brainco.dq, 0.5F) << "towards q 1";
  EXPECT_EQ(brainco.tau_est, -0.5F);
  EXPECT_EQ(brainco.lost, 0U);
}

TEST_F(MotorListTest, SharesAreInThousandths) {
  EXPECT_EQ(Second(Spanned("inspire"), {.q = 1.0009}).q, 0.25F);
  EXPECT_EQ(Second(Spanned("inspire"), {.q = 1.0011}).q, 0.249F);
}

TEST_F(MotorListTest, SlotsOfAnAbsentHandAreZero) {
  const robot::HandSpec spec = Spanned("inspire");
  MotorStatesMessage message(spec);
  message.Encode(std::array<robot::MotorReading, 2>{{{.q = 1}, {.q = 1}}});
  ASSERT_EQ(message.message().states._length, 3U);
  EXPECT_EQ(message.message().states._buffer[0].q, 0);
}

}  // namespace
}  // namespace understudy::wire
