#include "wire/register_codec.h"

#include <array>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>

#include "base/errors.h"

namespace understudy::wire {
namespace {

// A hand of two motors, of which angle 1000 is 0 rad and 0 is 2 rad.
robot::HandSpec TwoFingers() {
  robot::HandSpec spec{.name = "left", .law = "inspire_ftp"};
  for (const char* joint : {"a", "b"}) {
    spec.motors.push_back({.joint = joint, .torque_limit = 3, .knee_speed = 4, .span = {2, 0}});
  }
  return spec;
}

class RegisterCommandTest : public testing::Test {
 protected:
  struct Values {
    std::vector<std::int16_t> pos{0, 0}, angle{0, 0}, force{0, 0}, speed{0, 0};
  };

  robot::Refusal Read(int mode, Values values) {
    inspire_inspire_hand_ctrl message{};
    const auto put = [](dds_sequence_int16* to, std::vector<std::int16_t>* from) {
      to->_length = static_cast<std::uint32_t>(from->size());
      to->_buffer = from->data();
    };
    put(&message.pos_set, &values.pos);
    put(&message.angle_set, &values.angle);
    put(&message.force_set, &values.force);
    put(&message.speed_set, &values.speed);
    message.mode = static_cast<std::int8_t>(mode);
    return Decode(message, spec_, &command_);
  }

  const robot::HandSpec spec_ = TwoFingers();
  robot::RobotCommand command_;
};

constexpr int kAll = 15;

TEST_F(RegisterCommandTest, AnglesArePermilleOfTheWayToOpen) {
  ASSERT_EQ(Read(1, {.angle = {1000, 250}}), robot::Refusal::kNone);
  EXPECT_DOUBLE_EQ(command_.motors.at(0).q, 0);
  EXPECT_DOUBLE_EQ(command_.motors.at(1).q, 1.5);
}

TEST_F(RegisterCommandTest, PositionsAreHalfPermilleOfTheWayToClosedAndHoldOverAngles) {
  ASSERT_EQ(Read(3, {.pos = {2000, 500}, .angle = {1000, 1000}}), robot::Refusal::kNone);
  EXPECT_DOUBLE_EQ(command_.motors.at(0).q, 2);
  EXPECT_DOUBLE_EQ(command_.motors.at(1).q, 0.5);
}

TEST_F(RegisterCommandTest, ForceIsOf3000GramsAndSpeedOf1000) {
  ASSERT_EQ(Read(12, {.force = {3000, 1000}, .speed = {1000, 500}}), robot::Refusal::kNone);
  EXPECT_DOUBLE_EQ(command_.motors.at(0).tau, 3);
  EXPECT_DOUBLE_EQ(command_.motors[1].tau, 1);
  EXPECT_DOUBLE_EQ(command_.motors[0].dq, 4);
  EXPECT_DOUBLE_EQ(command_.motors[1].dq, 2);
}

TEST_F(RegisterCommandTest, SetsOnlyWhatTheModeSelects) {
  for (int mode = 0; mode <= kAll; ++mode) {
    ASSERT_EQ(Read(mode, {}), robot::Refusal::kNone);
    EXPECT_EQ(command_.motors.at(0).q != robot::kNoPosition, (mode & 3) != 0) << mode;
    EXPECT_EQ(command_.motors[0].tau >= 0, (mode & 4) != 0) << mode;
    EXPECT_EQ(command_.motors[0].dq != robot::kNoVelocity, (mode & 8) != 0) << mode;
  }
}

TEST_F(RegisterCommandTest, AValueBelowZeroLeavesItsMotorAsItIs) {
  ASSERT_EQ(
      Read(kAll, {.pos = {-1, -1}, .angle = {-1, 500}, .force = {-1, 3000}, .speed = {-1, 0}}),
      robot::Refusal::kNone);
  EXPECT_EQ(command_.motors.at(0).q, robot::kNoPosition);
  EXPECT_LT(command_.motors[0].tau, 0);
  EXPECT_EQ(command_.motors[0].dq, robot::kNoVelocity);
  EXPECT_DOUBLE_EQ(command_.motors[1].q, 1) << "the position is none, so the angle holds";
}

TEST_F(RegisterCommandTest, CutsWhatIsBeyondItsRange) {
  ASSERT_EQ(Read(13, {.angle = {1001, 32767}, .force = {3001, 0}, .speed = {1001, 0}}),
            robot::Refusal::kNone);
  EXPECT_DOUBLE_EQ(command_.motors.at(1).q, 0);
  EXPECT_DOUBLE_EQ(command_.motors[0].tau, 3);
  EXPECT_DOUBLE_EQ(command_.motors[0].dq, 4);
}

TEST_F(RegisterCommandTest, RefusesASelectedRegisterOfAnotherLengthAndNoOther) {
  ASSERT_EQ(Read(1, {}), robot::Refusal::kNone);
  EXPECT_EQ(Read(1, {.angle = {9}}), robot::Refusal::kMotorCount);
  EXPECT_EQ(Read(kAll, {.speed = {1, 2, 3}}), robot::Refusal::kMotorCount);
  EXPECT_EQ(command_.motors.at(1).q, 2) << "unchanged";
  EXPECT_EQ(Read(1, {.pos = {}, .force = {}, .speed = {}}), robot::Refusal::kNone);
}

class RegisterStateTest : public testing::Test {
 protected:
  struct Told {
    int pos, angle, force, current, err, status, temperature;
  };
  Told Tell(const robot::MotorReading& second) {
    message_.Encode(std::array{robot::MotorReading{}, second});
    const inspire_inspire_hand_state wire = message_.message();
    EXPECT_EQ(wire.status._length, 2U);
    return {wire.pos_act._buffer[1],    wire.angle_act._buffer[1], wire.force_act._buffer[1],
            wire.current._buffer[1],    wire.err._buffer[1],       wire.status._buffer[1],
            wire.temperature._buffer[1]};
  }
  static robot::MotorReading Following(double q, double tau = 0, double led_dq = 0) {
    return {.enabled = true, .led_dq = led_dq, .q = q, .tau = tau};
  }

  const robot::HandSpec spec_ = TwoFingers();
  RegisterStateMessage message_{spec_};
};

TEST_F(RegisterStateTest, TellsAngleAndPositionFromOppositeEndsAndTheHeatOfTheCasing) {
  robot::MotorReading reading = Following(1.5);
  reading.casing_c = 41.4;
  const Told told = Tell(reading);
  EXPECT_EQ(told.angle, 250);
  EXPECT_EQ(told.pos, 1500);
  EXPECT_EQ(told.temperature, 41);
  EXPECT_EQ(Tell(Following(2.1)).angle, 0);
  EXPECT_EQ(Tell(Following(2.1)).pos, 2000);
}

TEST_F(RegisterStateTest, ForceIsInGramsAndPositiveWhereItCloses) {
  EXPECT_EQ(Tell(Following(1, 1.5)).force, 1500);
  EXPECT_EQ(Tell(Following(1, -1)).force, -1000);
  EXPECT_EQ(Tell(Following(1, -1)).current, 250);
}

TEST_F(RegisterStateTest, StatusTellsWhatAMotorDoes) {
  using Message = RegisterStateMessage;
  EXPECT_EQ(Tell({}).status, Message::kReached) << "no command came";
  EXPECT_EQ(Tell(Following(1, 0, -2)).status, Message::kOpens);
  EXPECT_EQ(Tell(Following(1, 0, 2)).status, Message::kCloses);
  EXPECT_EQ(Tell(Following(1)).status, Message::kReached);
  robot::MotorReading limited = Following(1, 1);
  limited.most = 1;
  EXPECT_EQ(Tell(limited).status, Message::kForce);
  EXPECT_EQ(Tell(limited).err, 0);
  limited.dq = 3;
  limited.led_dq = 4;
  EXPECT_EQ(Tell(limited).status, Message::kCloses) << "it still moves";
  EXPECT_EQ(Tell(Following(1, 3)).status, Message::kForce) << "the most that it can";
  EXPECT_EQ(Tell(Following(1, -3)).status, Message::kStalled);
  EXPECT_EQ(Tell(Following(1, -3)).err, Message::kStallError);
}

TEST_F(RegisterStateTest, AMotorThatIsMovedAgainstAllItHasIsAtTheLimitOfItsCurrent) {
  using Message = RegisterStateMessage;
  robot::MotorReading forced = Following(1, 3);
  forced.dq = -3;
  EXPECT_EQ(Tell(forced).status, Message::kCurrent);
  EXPECT_EQ(Tell(forced).err, Message::kCurrentError);
  forced.tau = -3;
  EXPECT_NE(Tell(forced).status, Message::kCurrent) << "it moves where it pushes";
  forced.tau = forced.most = 1;
  EXPECT_NE(Tell(forced).status, Message::kCurrent) << "its register of force has less";
}

TEST_F(RegisterStateTest, FaultsAreBitsOfErrAndStopTheMotor) {
  using Message = RegisterStateMessage;
  robot::MotorReading hot = Following(1);
  hot.overheated = true;
  EXPECT_EQ(Tell(hot).err, Message::kHeatError);
  EXPECT_EQ(Tell(hot).status, Message::kFailed);
  robot::MotorReading mute = Following(1);
  mute.silent = true;
  EXPECT_EQ(Tell(mute).err, Message::kLinkError);
  EXPECT_EQ(Tell(mute).status, Message::kFailed);
  robot::MotorReading blind = Following(1);
  blind.encoder_error = true;
  EXPECT_EQ(Tell(blind).err, Message::kMotorError);
}

// A hand whose pads fit.
robot::HandSpec Padded() {
  robot::HandSpec spec = TwoFingers();
  for (const std::size_t length : TouchMessage::Lengths()) {
    const int columns = length == 9 ? 3 : 8;
    spec.pads.push_back({.rows = static_cast<int>(length) / columns, .columns = columns});
  }
  return spec;
}

TEST(TouchMessageTest, FieldsHaveTheCellsOfThePadsInTheirOrder) {
  TouchMessage message(Padded());
  std::vector<float> counts(1062);
  std::iota(counts.begin(), counts.end(), 0.0F);
  message.Encode(counts);
  const inspire_inspire_hand_touch wire = message.message();
  EXPECT_EQ(wire.fingerone_tip_touch._length, 9U);
  EXPECT_EQ(wire.fingerone_top_touch._buffer[0], 9);
  EXPECT_EQ(wire.fingertwo_tip_touch._buffer[0], 185);
  EXPECT_EQ(wire.fingerfive_tip_touch._buffer[0], 740);
  EXPECT_EQ(wire.fingerfive_middle_touch._buffer[8], 853);
  EXPECT_EQ(wire.fingerfive_palm_touch._length, 96U);
  EXPECT_EQ(wire.palm_touch._length, 112U);
  EXPECT_EQ(wire.palm_touch._buffer[111], 1061);
}

TEST(TouchMessageTest, StaysWholeWhenMoved) {
  TouchMessage message(Padded());
  TouchMessage moved = std::move(message);
  moved.Encode(std::vector<float>(1062, 7));
  EXPECT_EQ(moved.message().palm_touch._buffer[111], 7);
}

TEST(TouchMessageTest, RefusesAHandWithOtherPads) {
  robot::HandSpec spec = Padded();
  spec.pads[0].rows = 2;
  EXPECT_THROW(TouchMessage{spec}, ModelError);
  EXPECT_THROW(TouchMessage{TwoFingers()}, ModelError);
}

}  // namespace
}  // namespace understudy::wire
