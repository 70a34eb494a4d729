// Tests the topics of hands.
#include <array>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "base/errors.h"
#include "tests/support/allocations.h"
#include "tests/support/new_domain.h"
#include "tests/wire/client.h"
#include "tests/wire/robots.h"
#include "wire/port.h"
#include "wire/register_codec.h"
#include "wire/topics.h"

namespace understudy::wire {
namespace {

using HandCmd = unitree_hg_msg_dds__HandCmd_;
using HandState = unitree_hg_msg_dds__HandState_;

constexpr bus::Topic<HandCmd> kLeftCmd{"rt/dex/left/cmd", &unitree_hg_msg_dds__HandCmd__desc};
constexpr bus::Topic<HandCmd> kRightCmd{"rt/dex/right/cmd", &unitree_hg_msg_dds__HandCmd__desc};

constexpr bus::Topic<HandState> State(const char* name) {
  return {name, &unitree_hg_msg_dds__HandState__desc};
}

// Two hands of two motors.
robot::RobotSpec Handy() {
  robot::RobotSpec spec = HgRobot();
  for (const char* side : {"left", "right"}) {
    spec.hands.push_back({.name = side,
                          .topic = std::string("dex/") + side,
                          .hz = 1000.0 / kHandStep,
                          .motors = {{.joint = "thumb"}, {.joint = "index"}},
                          .pads = {{.taxels = {0}}}});
  }
  return spec;
}

// A robot on the wire, in a domain of its own, and what was taken from one of its hands.
struct Played {
  explicit Played(robot::RobotSpec robot = Handy())
      : participant("lo", test::NewDomain()),
        spec(std::move(robot)),
        port(participant, spec, kTimestep) {}
  bool Take(std::size_t hand) { return port.Take(robot::kFirstHandTopic + hand, &command, &wire); }

  bus::Participant participant;
  robot::RobotSpec spec;
  Port port;
  robot::RobotCommand command{.motors = std::vector<robot::MotorCommand>(2)};
  robot::Refusal wire = robot::Refusal::kNone;
};

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
std::pair<float, std::uint32_t> Heard(bus::Reader<HandState>* reader) {
  std::pair<float, std::uint32_t> heard{-1, 0};
  test::Eventually([&] {
    return reader->Take(
               [&](const HandState& state, bus::WriterHandle) {
                 heard = {state.motor_state._buffer[0].q, state.press_sensor_state._length};
               },
               1) == 1;
  });
  return heard;
}

TEST(HandPortTest, HasNoCommandBeforeTheFirst) {
  Played robot;
  EXPECT_FALSE(robot.Take(0));
  EXPECT_FALSE(robot.Take(1));
}

TEST(HandPortTest, TakesTheCommandsOfEachHandOldestFirst) {
  Played robot;
  bus::Writer<HandCmd> left(robot.participant, kLeftCmd);
  bus::Writer<HandCmd> right(robot.participant, kRightCmd);
  ASSERT_TRUE(test::Eventually(
      [&] { return left.matched_readers() == 1 && right.matched_readers() == 1; }));
  ASSERT_TRUE(right.Write(Command(1).message));
  ASSERT_TRUE(right.Write(Command(2).message));
  ASSERT_TRUE(test::Eventually([&] { return robot.Take(1); }));
  EXPECT_EQ(robot.wire, robot::Refusal::kNone);
  EXPECT_EQ(robot.command.motors[1].q, 1);
  ASSERT_TRUE(robot.Take(1));
  EXPECT_EQ(robot.command.motors[1].q, 2);
  EXPECT_FALSE(robot.Take(1));
  EXPECT_FALSE(robot.Take(0));
}

TEST(HandPortTest, TellsACommandForAnotherNumberOfMotors) {
  Played robot;
  bus::Writer<HandCmd> left(robot.participant, kLeftCmd);
  ASSERT_TRUE(test::Eventually([&] { return left.matched_readers() == 1; }));
  for (const std::uint32_t length : {0U, 1U, 3U}) {
    ASSERT_TRUE(left.Write(Command(1, length).message));
    ASSERT_TRUE(test::Eventually([&] { return robot.Take(0); }));
    EXPECT_EQ(robot.wire, robot::Refusal::kMotorCount) << length;
  }
}

TEST(HandPortTest, PublishesEachHandFastAndSlow) {
  Played robot;
  bus::Reader<HandState> left(robot.participant, State("rt/dex/left/state"));
  bus::Reader<HandState> right(robot.participant, State("rt/dex/right/state"));
  bus::Reader<HandState> lf_left(robot.participant, State("rt/lf/dex/left/state"));
  bus::Reader<HandState> lf_right(robot.participant, State("rt/lf/dex/right/state"));
  robot::RobotState state = StateOf(robot.spec);
  state.motors[4].q = 1;  // behind the body's four and the left hand's two
  state.motors[6].q = 2;
  robot.port.Publish(state, kHandStep);
  EXPECT_EQ(Heard(&left), std::pair(1.0F, 1U));
  EXPECT_EQ(Heard(&right), std::pair(2.0F, 1U));
  const auto ignore = [](const auto&, bus::WriterHandle) {};
  EXPECT_EQ(lf_left.Take(ignore), 0);
  robot.port.Publish(state, kLfStep);
  EXPECT_EQ(Heard(&lf_left), std::pair(1.0F, 1U));
  EXPECT_EQ(Heard(&lf_right), std::pair(2.0F, 1U));
  robot.port.Publish(state, kLowStateStep * kMotionStep);
  EXPECT_EQ(left.Take(ignore), 0);
  EXPECT_EQ(robot.port.counts().write_failures, 0U);
}

TEST(HandPortTest, TalksInListsOfMotorsWhereTheLawSaysSo) {
  robot::RobotSpec spec = HgRobot();
  spec.hands = {{.name = "claw",
                 .law = "dex1",
                 .topic = "claw",
                 .hz = 1000.0 / kHandStep,
                 .motors = {{.joint = "a"}, {.joint = "b"}}}};
  Played robot(spec);
  bus::Writer<unitree_go_msg_dds__MotorCmds_> writer(
      robot.participant, {"rt/claw/cmd", &unitree_go_msg_dds__MotorCmds__desc});
  bus::Reader<unitree_go_msg_dds__MotorStates_> reader(
      robot.participant, {"rt/claw/state", &unitree_go_msg_dds__MotorStates__desc});
  bus::Reader<unitree_go_msg_dds__MotorStates_> slow(
      robot.participant, {"rt/lf/claw/state", &unitree_go_msg_dds__MotorStates__desc});
  ASSERT_TRUE(test::Eventually(
      [&] { return writer.matched_readers() == 1 && reader.matched_writers() == 1; }));
  EXPECT_EQ(slow.matched_writers(), 0);
  std::array<unitree_go_msg_dds__MotorCmd_, 2> motors{};
  motors[1].q = 2;
  unitree_go_msg_dds__MotorCmds_ command{
      .cmds = {._maximum = 2, ._length = 2, ._buffer = motors.data(), ._release = false}};
  ASSERT_TRUE(writer.Write(command));
  ASSERT_TRUE(test::Eventually([&] { return robot.Take(0); }));
  EXPECT_EQ(robot.command.motors[1].q, 2);
  robot::RobotState state = StateOf(robot.spec);
  state.motors[5].q = 3;
  robot.port.Publish(state, kHandStep);
  float q = 0;
  ASSERT_TRUE(test::Eventually([&] {
    return reader.Take(
               [&](const auto& heard, bus::WriterHandle) { q = heard.states._buffer[1].q; }) == 1;
  }));
  EXPECT_EQ(q, 3);
}

// An FTP hand of one motor, whose first pad has the first of 1062 cells.
robot::RobotSpec Feeling() {
  robot::RobotSpec spec = HgRobot();
  robot::HandSpec hand{.name = "left", .law = "inspire_ftp", .topic = "touchy/*/l"};
  hand.hz = hand.touch.hz = 1000.0 / kHandStep;
  hand.motors = {{.joint = "a", .torque_limit = 1, .knee_speed = 1, .span = {2, 0}}};
  for (const std::size_t cells : TouchMessage::Lengths()) {
    const int columns = cells == 9 ? 3 : 8;
    hand.pads.push_back({.rows = static_cast<int>(cells) / columns, .columns = columns});
  }
  spec.hands = {hand};
  return spec;
}

TEST(HandPortTest, TalksInRegistersWhereTheLawSaysSo) {
  Played robot(Feeling());
  bus::Writer<inspire_inspire_hand_ctrl> writer(
      robot.participant, {"rt/touchy/ctrl/l", &inspire_inspire_hand_ctrl_desc});
  bus::Reader<inspire_inspire_hand_state> states(
      robot.participant, {"rt/touchy/state/l", &inspire_inspire_hand_state_desc});
  ASSERT_TRUE(test::Eventually(
      [&] { return writer.matched_readers() == 1 && states.matched_writers() == 1; }));
  std::int16_t angle = 250;
  inspire_inspire_hand_ctrl command{};
  command.angle_set = {._maximum = 1, ._length = 1, ._buffer = &angle, ._release = false};
  command.mode = 1;
  ASSERT_TRUE(writer.Write(command));
  ASSERT_TRUE(test::Eventually([&] { return robot.Take(0); }));
  EXPECT_EQ(robot.wire, robot::Refusal::kNone);
  EXPECT_EQ(robot.command.motors.at(0).q, 1.5);
  robot::RobotState state = StateOf(robot.spec);
  state.motors[4].q = 0.5;
  robot.port.Publish(state, kHandStep);
  int told = 0;
  ASSERT_TRUE(test::Eventually([&] {
    return states.Take([&](const auto& heard, bus::WriterHandle) {
      told = heard.angle_act._buffer[0];
    }) == 1;
  }));
  EXPECT_EQ(told, 750);
}

TEST(HandPortTest, HearsHandSdkWhereAHandHasAPlaceInIt) {
  const bus::Topic<unitree_go_msg_dds__MotorCmds_> topic{kHandSdk};
  const Played without;
  bus::Writer<unitree_go_msg_dds__MotorCmds_> unheard(without.participant, topic);
  const bus::Writer<HandCmd> heard(without.participant, kLeftCmd);
  ASSERT_TRUE(test::Eventually([&] { return heard.matched_readers() == 1; }));
  EXPECT_EQ(unheard.matched_readers(), 0);
  robot::RobotSpec spec = Handy();
  spec.hands[1].sdk_slot = 2;
  Played robot(spec);
  bus::Writer<unitree_go_msg_dds__MotorCmds_> writer(robot.participant, topic);
  ASSERT_TRUE(test::Eventually([&] { return writer.matched_readers() == 1; }));
  std::array<unitree_go_msg_dds__MotorCmd_, 4> motors{};
  motors[0].mode = 100;
  motors[3].tau = 0.25F;
  ASSERT_TRUE(writer.Write(
      {.cmds = {._maximum = 4, ._length = 4, ._buffer = motors.data(), ._release = false}}));
  ASSERT_TRUE(test::Eventually(
      [&] { return robot.port.Take(robot::kHandSdkTopic, &robot.command, &robot.wire); }));
  EXPECT_EQ(robot.wire, robot::Refusal::kNone);
  EXPECT_EQ(robot.command.weight, 1);
  ASSERT_EQ(robot.command.motors.size(), 4U);
  EXPECT_EQ(robot.command.motors[3].tau, -0.25);
}

TEST(HandPortTest, TellsTouchToReadersAndWhetherThereAreAny) {
  Played robot(Feeling());
  EXPECT_FALSE(robot.port.ReadsTouch(kHandStep));
  bus::Reader<inspire_inspire_hand_touch> reader(
      robot.participant, {"rt/touchy/touch/l", &inspire_inspire_hand_touch_desc});
  ASSERT_TRUE(test::Eventually([&] { return robot.port.ReadsTouch(kHandStep); }));
  EXPECT_FALSE(robot.port.ReadsTouch(kHandStep + 1)) << "no message is due";
  robot::RobotState state = StateOf(robot.spec);
  state.touch.assign(1062, 0);
  state.touch[9] = 42;
  robot.port.Publish(state, kHandStep);
  int told = 0;
  ASSERT_TRUE(test::Eventually([&] {
    return reader.Take([&](const auto& heard, bus::WriterHandle) {
      told = heard.fingerone_top_touch._buffer[0];
    }) == 1;
  }));
  EXPECT_EQ(told, 42);
}

TEST(HandPortTest, HasNoTopicsWhereTheRobotHasNoHands) {
  Played robot(HgRobot());
  bus::Writer<HandCmd> left(robot.participant, kLeftCmd);
  bus::Reader<unitree_hg_msg_dds__LowState_> lowstate(
      robot.participant, {"rt/lowstate", &unitree_hg_msg_dds__LowState__desc});
  ASSERT_TRUE(test::Eventually([&] { return lowstate.matched_writers() == 1; }));
  EXPECT_EQ(left.matched_readers(), 0);
}

// Cyclone makes and frees a sequence's memory for each sample in its own C, which is not counted.
TEST(HandPortTest, AllocatesNothingInATick) {
  Played robot;
  bus::Writer<HandCmd> left(robot.participant, kLeftCmd);
  ASSERT_TRUE(test::Eventually([&] { return left.matched_readers() == 1; }));
  const robot::RobotState state = StateOf(robot.spec);
  const Command message(1);
  const std::uint64_t before = test::Allocations();
  left.Write(message.message);
  const bool taken = robot.Take(0);
  robot.port.Publish(state, kHandStep * kLfStep);
  const std::uint64_t after = test::Allocations();
  EXPECT_TRUE(taken);
  EXPECT_EQ(after - before, 0);
}

TEST(HandPortTest, RefusesAHandThatDoesNotFit) {
  const bus::Participant participant("lo", test::NewDomain());
  robot::RobotSpec spec = Handy();
  spec.hands[0].motors.resize(17);
  EXPECT_THROW(Port(participant, spec, kTimestep), ModelError);
  spec = Handy();
  spec.hands[1].pads[0].taxels = {12};
  EXPECT_THROW(Port(participant, spec, kTimestep), ModelError);
}

}  // namespace
}  // namespace understudy::wire
