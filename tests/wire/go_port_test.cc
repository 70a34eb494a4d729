#include "wire/go_port.h"

#include <memory>

#include <gmock/gmock.h>

#include "robot/errors.h"
#include "tests/wire/allocations.h"
#include "tests/wire/client.h"
#include "tests/wire/robots.h"
#include "wire/message_crc.h"
#include "wire/open_port.h"
#include "wire/topics.h"

namespace understudy {
namespace {

unitree_go_msg_dds__LowCmd_ Command(float q) {
  unitree_go_msg_dds__LowCmd_ message{};
  message.head[0] = 0xFE;
  message.head[1] = 0xEF;
  message.level_flag = 0xFF;
  message.motor_cmd[4].mode = 1;
  message.motor_cmd[4].q = q;
  message.motor_cmd[0].kp = 1;  // no motor there
  message.crc = MessageCrc(message);
  return message;
}

TEST(GoPortTest, HasNoCommandBeforeTheFirst) {
  const Participant participant("lo", 151);
  const RobotSpec spec = GoRobot();
  GoPort port(participant, spec);
  RobotCommand command = CommandOf(spec);
  Refusal wire = Refusal::kNone;
  EXPECT_EQ(port.command_writers(), 0);
  EXPECT_FALSE(port.TakeCommand(&command, &wire));
}

TEST(GoPortTest, TakesCommandsOldestFirst) {
  const Participant participant("lo", 152);
  const RobotSpec spec = GoRobot();
  GoPort port(participant, spec);
  Writer<unitree_go_msg_dds__LowCmd_> client(participant, kGoLowCmd);
  ASSERT_TRUE(Eventually([&] { return port.command_writers() == 1; }));
  ASSERT_TRUE(client.Write(Command(1)));
  auto broken = Command(2);
  broken.crc ^= 1;
  ASSERT_TRUE(client.Write(broken));

  RobotCommand command = CommandOf(spec);
  Refusal wire = Refusal::kNone;
  ASSERT_TRUE(port.TakeCommand(&command, &wire));
  EXPECT_EQ(wire, Refusal::kNone);
  EXPECT_EQ(command.motors[1].q, 1);
  ASSERT_TRUE(port.TakeCommand(&command, &wire));
  EXPECT_EQ(wire, Refusal::kCrc);
  EXPECT_EQ(command.motors[1].q, 2);
  EXPECT_FALSE(port.TakeCommand(&command, &wire));
  EXPECT_EQ(port.counts().unused_slots, 2);
}

TEST(GoPortTest, PublishesWhatIsDueAndNothingElse) {
  const Participant participant("lo", 153);
  const RobotSpec spec = GoRobot();
  const std::unique_ptr<RobotPort> port = OpenPort(participant, spec);
  Reader<unitree_go_msg_dds__LowState_> lowstate(participant, kGoLowState);
  Reader<unitree_go_msg_dds__LowState_> lf_lowstate(participant, kGoLfLowState);
  Reader<unitree_go_msg_dds__SportModeState_> motion(participant, kSportModeState);
  Reader<unitree_go_msg_dds__SportModeState_> lf_motion(participant, kLfSportModeState);
  for (const ReaderCore* reader :
       std::initializer_list<const ReaderCore*>{&lowstate, &lf_lowstate, &motion, &lf_motion}) {
    ASSERT_TRUE(Eventually([&] { return reader->matched_writers() == 1; }));
  }
  RobotState state = StateOf(spec);

  state.tick_ms = 2;
  port->Publish(state, {.lowstate = true});
  const auto first = Next(&lowstate);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->tick, 2);
  EXPECT_EQ(first->crc, MessageCrc(*first));

  state.tick_ms = 3;
  port->Publish(state, {.motion = true});
  ASSERT_TRUE(Next(&motion));

  state.tick_ms = 4;
  port->Publish(state, {.lf = true});
  const auto lf = Next(&lf_lowstate);
  ASSERT_TRUE(lf);
  EXPECT_EQ(lf->tick, 4);
  EXPECT_TRUE(Next(&lf_motion));

  const auto ignore = [](const auto&, WriterHandle) {};
  EXPECT_EQ(lowstate.Take(ignore) + lf_lowstate.Take(ignore) + motion.Take(ignore) +
                lf_motion.Take(ignore),
            0);
  EXPECT_EQ(port->counts().write_failures, 0);
}

TEST(GoPortTest, AllocatesNothingInATick) {
  const Participant participant("lo", 154);
  const RobotSpec spec = GoRobot();
  GoPort port(participant, spec);
  Writer<unitree_go_msg_dds__LowCmd_> client(participant, kGoLowCmd);
  ASSERT_TRUE(Eventually([&] { return port.command_writers() == 1; }));
  const RobotState state = StateOf(spec);
  RobotCommand command = CommandOf(spec);
  Refusal wire = Refusal::kNone;
  const auto message = Command(1);
  const std::uint64_t before = Allocations();
  client.Write(message);
  const bool taken = port.TakeCommand(&command, &wire);
  port.Publish(state, {.lowstate = true, .motion = true, .lf = true});
  const std::uint64_t after = Allocations();
  EXPECT_TRUE(taken);
  EXPECT_EQ(after - before, 0);
}

TEST(GoPortTest, RefusesARobotThatDoesNotFit) {
  const Participant participant("lo", 155);
  RobotSpec spec = GoRobot();
  spec.motors.back().slot = 20;
  EXPECT_THROW(GoPort(participant, spec), ModelError);
}

}  // namespace
}  // namespace understudy
