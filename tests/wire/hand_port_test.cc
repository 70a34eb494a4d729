#include "wire/hand_port.h"

#include <array>

#include <gmock/gmock.h>

#include "robot/errors.h"
#include "tests/support/allocations.h"
#include "tests/wire/client.h"
#include "tests/wire/robots.h"
#include "wire/hg_port.h"

namespace understudy {
namespace {

using HandCmd = unitree_hg_msg_dds__HandCmd_;
using HandState = unitree_hg_msg_dds__HandState_;

constexpr Topic<HandCmd> kLeftCmd{"rt/dex/left/cmd", &unitree_hg_msg_dds__HandCmd__desc};
constexpr Topic<HandCmd> kRightCmd{"rt/dex/right/cmd", &unitree_hg_msg_dds__HandCmd__desc};

constexpr Topic<HandState> State(const char* name) {
  return {name, &unitree_hg_msg_dds__HandState__desc};
}

// Two hands of two motors.
RobotSpec Handy() {
  RobotSpec spec = HgRobot();
  for (const char* side : {"left", "right"}) {
    spec.hands.push_back({.name = side,
                          .topic = std::string("dex/") + side,
                          .motors = {{.joint = "thumb"}, {.joint = "index"}},
                          .pads = {{.taxels = {0}}}});
  }
  return spec;
}

RobotState HandyState(const RobotSpec& spec) {
  RobotState state = StateOf(spec);
  state.hands.assign(2, {.motors = std::vector<MotorReading>(2), .timed_out = {0, 0}});
  return state;
}

// A command to two motors.
struct Command {
  explicit Command(float q, std::uint32_t length = 2) {
    for (std::size_t i = 0; i < motors.size(); ++i) {
      motors[i].mode = static_cast<std::uint8_t>(i | 1 << 4);
      motors[i].q = q;
    }
    message.motor_cmd = {
        ._maximum = length, ._length = length, ._buffer = motors.data(), ._release = false};
  }
  std::array<unitree_hg_msg_dds__MotorCmd_, 3> motors{};
  HandCmd message{};
};

// The angle of the first motor and the number of pads of the next state.
std::pair<float, std::uint32_t> Heard(Reader<HandState>* reader) {
  std::pair<float, std::uint32_t> heard{-1, 0};
  Eventually([&] {
    return reader->Take(
               [&](const HandState& state, WriterHandle) {
                 heard = {state.motor_state._buffer[0].q, state.press_sensor_state._length};
               },
               1) == 1;
  });
  return heard;
}

TEST(HandPortTest, HasNoCommandBeforeTheFirst) {
  const Participant participant("lo", 190);
  const RobotSpec spec = Handy();
  HgPort port(participant, spec);
  HandCommand command;
  Refusal wire = Refusal::kNone;
  EXPECT_FALSE(port.TakeHandCommand(0, &command, &wire));
  EXPECT_FALSE(port.TakeHandCommand(1, &command, &wire));
}

TEST(HandPortTest, TakesTheCommandsOfEachHandOldestFirst) {
  const Participant participant("lo", 191);
  const RobotSpec spec = Handy();
  HgPort port(participant, spec);
  Writer<HandCmd> left(participant, kLeftCmd);
  Writer<HandCmd> right(participant, kRightCmd);
  ASSERT_TRUE(
      Eventually([&] { return left.matched_readers() == 1 && right.matched_readers() == 1; }));
  ASSERT_TRUE(right.Write(Command(1).message));
  ASSERT_TRUE(right.Write(Command(2).message));
  HandCommand command;
  Refusal wire = Refusal::kNone;
  ASSERT_TRUE(Eventually([&] { return port.TakeHandCommand(1, &command, &wire); }));
  EXPECT_EQ(wire, Refusal::kNone);
  EXPECT_EQ(command.motors[1].motor.q, 1);
  ASSERT_TRUE(port.TakeHandCommand(1, &command, &wire));
  EXPECT_EQ(command.motors[1].motor.q, 2);
  EXPECT_FALSE(port.TakeHandCommand(1, &command, &wire));
  EXPECT_FALSE(port.TakeHandCommand(0, &command, &wire));
}

TEST(HandPortTest, TellsACommandForAnotherNumberOfMotors) {
  const Participant participant("lo", 192);
  const RobotSpec spec = Handy();
  HgPort port(participant, spec);
  Writer<HandCmd> left(participant, kLeftCmd);
  ASSERT_TRUE(Eventually([&] { return left.matched_readers() == 1; }));
  HandCommand command;
  Refusal wire = Refusal::kNone;
  for (const std::uint32_t length : {0U, 1U, 3U}) {
    ASSERT_TRUE(left.Write(Command(1, length).message));
    ASSERT_TRUE(Eventually([&] { return port.TakeHandCommand(0, &command, &wire); }));
    EXPECT_EQ(wire, Refusal::kMotorCount) << length;
  }
}

TEST(HandPortTest, PublishesEachHandFastAndSlow) {
  const Participant participant("lo", 193);
  const RobotSpec spec = Handy();
  HgPort port(participant, spec);
  Reader<HandState> left(participant, State("rt/dex/left/state"));
  Reader<HandState> right(participant, State("rt/dex/right/state"));
  Reader<HandState> lf_left(participant, State("rt/lf/dex/left/state"));
  Reader<HandState> lf_right(participant, State("rt/lf/dex/right/state"));
  RobotState state = HandyState(spec);
  state.hands[0].motors[0].q = 1;
  state.hands[1].motors[0].q = 2;
  port.Publish(state, {.hands = true});
  EXPECT_EQ(Heard(&left), std::pair(1.0F, 1U));
  EXPECT_EQ(Heard(&right), std::pair(2.0F, 1U));
  const auto ignore = [](const auto&, WriterHandle) {};
  EXPECT_EQ(lf_left.Take(ignore), 0);
  port.Publish(state, {.lf = true});
  EXPECT_EQ(Heard(&lf_left), std::pair(1.0F, 1U));
  EXPECT_EQ(Heard(&lf_right), std::pair(2.0F, 1U));
  port.Publish(state, {.lowstate = true, .motion = true});
  EXPECT_EQ(left.Take(ignore), 0);
  EXPECT_EQ(port.counts().write_failures, 0U);
}

TEST(HandPortTest, HasNoTopicsWhereTheRobotHasNoHands) {
  const Participant participant("lo", 194);
  const RobotSpec spec = HgRobot();
  HgPort port(participant, spec);
  Writer<HandCmd> left(participant, kLeftCmd);
  Reader<unitree_hg_msg_dds__LowState_> lowstate(
      participant, {"rt/lowstate", &unitree_hg_msg_dds__LowState__desc});
  ASSERT_TRUE(Eventually([&] { return lowstate.matched_writers() == 1; }));
  EXPECT_EQ(left.matched_readers(), 0);
}

// Cyclone makes and frees a sequence's memory for each sample in its own C, which is not counted.
TEST(HandPortTest, AllocatesNothingInATick) {
  const Participant participant("lo", 195);
  const RobotSpec spec = Handy();
  HgPort port(participant, spec);
  Writer<HandCmd> left(participant, kLeftCmd);
  ASSERT_TRUE(Eventually([&] { return left.matched_readers() == 1; }));
  const RobotState state = HandyState(spec);
  const Command message(1);
  HandCommand command{.motors = std::vector<HandMotorCommand>(2)};
  Refusal wire = Refusal::kNone;
  const std::uint64_t before = Allocations();
  left.Write(message.message);
  const bool taken = port.TakeHandCommand(0, &command, &wire);
  port.Publish(state, {.hands = true, .lf = true});
  const std::uint64_t after = Allocations();
  EXPECT_TRUE(taken);
  EXPECT_EQ(after - before, 0);
}

TEST(HandPortTest, RefusesAHandThatDoesNotFit) {
  const Participant participant("lo", 196);
  HandSpec hand = Handy().hands[0];
  hand.motors.resize(17);
  EXPECT_THROW(HandPort(participant, hand), ModelError);
  hand = Handy().hands[0];
  hand.pads[0].taxels = {12};
  EXPECT_THROW(HandPort(participant, hand), ModelError);
}

}  // namespace
}  // namespace understudy
