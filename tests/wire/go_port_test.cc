#include <gmock/gmock.h>

#include "tests/bus/garbage_writer.h"
#include "tests/support/new_domain.h"
#include "tests/wire/client.h"
#include "tests/wire/go_command.h"
#include "tests/wire/robots.h"
#include "wire/message_crc.h"
#include "wire/port.h"
#include "wire/topics.h"

namespace understudy::wire {
namespace {

TEST(GoPortTest, CountsWhatIsSetInSlotsWithoutAMotor) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  bus::Writer<unitree_go_msg_dds__LowCmd_> client(participant, kGoLowCmd);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  unitree_go_msg_dds__LowCmd_ message = InitialGoCommand();
  message.motor_cmd[0].kp = 1;
  message.crc = MessageCrc(message);
  robot::RobotCommand command = CommandOf(spec);
  robot::Refusal wire = robot::Refusal::kNone;
  for (std::uint64_t times = 1; times <= 2; ++times) {
    ASSERT_TRUE(client.Write(message));
    ASSERT_TRUE(port.Take(robot::kLowCmdTopic, &command, &wire));
    EXPECT_EQ(wire, robot::Refusal::kNone);
    EXPECT_EQ(port.counts().unused_slots, times);
    EXPECT_EQ(port.TakeNews().unused_slot, times == 1);
  }
  EXPECT_FALSE(port.TakeNews().unset_head);
}

TEST(GoPortTest, WarnsOfNoProgramThatFillsAllSlotsAlike) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  bus::Writer<unitree_go_msg_dds__LowCmd_> client(participant, kGoLowCmd);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  unitree_go_msg_dds__LowCmd_ message = InitialGoCommand();
  for (auto& motor : message.motor_cmd) motor.kp = 60;
  message.crc = MessageCrc(message);
  robot::RobotCommand command = CommandOf(spec);
  robot::Refusal wire = robot::Refusal::kNone;
  ASSERT_TRUE(client.Write(message));
  ASSERT_TRUE(port.Take(robot::kLowCmdTopic, &command, &wire));
  EXPECT_EQ(port.counts().unused_slots, 17U);
  EXPECT_FALSE(port.TakeNews().unused_slot);
}

TEST(GoPortTest, TellsOfTheFirstHeadThatWasLeftUnset) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  bus::Writer<unitree_go_msg_dds__LowCmd_> client(participant, kGoLowCmd);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  unitree_go_msg_dds__LowCmd_ message = InitialGoCommand();
  message.head[0] = message.head[1] = message.level_flag = 0;
  robot::RobotCommand command = CommandOf(spec);
  robot::Refusal wire = robot::Refusal::kNone;
  for (std::uint64_t times = 1; times <= 2; ++times) {
    ASSERT_TRUE(client.Write(message));
    ASSERT_TRUE(port.Take(robot::kLowCmdTopic, &command, &wire));
    EXPECT_EQ(port.counts().unset_heads, times);
    EXPECT_EQ(port.TakeNews().unset_head, times == 1);
  }
}

TEST(GoPortTest, TellsOnceOfSeveralWriters) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  const bus::Writer<unitree_go_msg_dds__LowCmd_> one(participant, kGoLowCmd);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  EXPECT_EQ(port.TakeNews().writers, 0);
  const bus::Writer<unitree_go_msg_dds__LowCmd_> two(participant, kGoLowCmd);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 2; }));
  EXPECT_EQ(port.TakeNews().writers, 2);
  EXPECT_EQ(port.TakeNews().writers, 0);
}

// The ticks that come for three messages of ticks 1, 2 and 3, of which the second goes out over a
// link with that fault.
std::vector<std::uint32_t> TicksOver(const robot::LinkEffects& fault, bool* wrong_crc = nullptr) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  bus::Reader<unitree_go_msg_dds__LowState_> reader(participant, kGoLowState);
  EXPECT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  robot::RobotState state = StateOf(spec);
  for (const std::int64_t tick : {1, 2, 3}) {
    std::vector<robot::LinkEffects> links(port.topics().size());
    if (tick == 2) links[0] = fault;  // rt/lowstate
    state.tick_ms = tick;
    port.BeginTick(kLowStateStep * kTimestep, {.publications = links});
    port.Publish(state, kLowStateStep);
  }
  std::vector<std::uint32_t> ticks;
  while (const auto message = Next(&reader)) {
    if (message->crc != MessageCrc(*message) && wrong_crc != nullptr) {
      *wrong_crc = message->tick == 2;
    }
    ticks.push_back(message->tick);
    if (message->tick == 3 && !fault.reorders) break;
    if (message->tick == 2 && fault.reorders) break;
  }
  return ticks;
}

TEST(GoPortTest, SendsOverAFaultyLinkWhatItLeaves) {
  using testing::ElementsAre;
  EXPECT_EQ(std::string(kGoLowState.name), "rt/lowstate");
  EXPECT_THAT(TicksOver({}), ElementsAre(1, 2, 3));
  EXPECT_THAT(TicksOver({.drops = true}), ElementsAre(1, 3));
  EXPECT_THAT(TicksOver({.doubles = true}), ElementsAre(1, 2, 2, 3));
  EXPECT_THAT(TicksOver({.reorders = true}), ElementsAre(1, 3, 2));
  bool wrong_crc = false;
  EXPECT_THAT(TicksOver({.damages = true}, &wrong_crc), ElementsAre(1, 2, 3));
  EXPECT_TRUE(wrong_crc);
}

TEST(GoPortTest, SendsLaterWhatALinkDelaysAndNothingBeforeIt) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  bus::Reader<unitree_go_msg_dds__LowState_> reader(participant, kGoLowState);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  std::vector<robot::LinkEffects> links(port.topics().size());
  robot::RobotState state = StateOf(spec);
  const auto publish = [&](std::int64_t step, double delay) {
    links[0].delay = delay;
    state.tick_ms = step;
    port.BeginTick(static_cast<double>(step) * kTimestep, {.publications = links});
    port.Publish(state, step);
  };
  constexpr std::int64_t period = kLowStateStep * kMotionStep * kLfStep;  // next to it none is due
  publish(period, 2.5 * static_cast<double>(period) * kTimestep);
  EXPECT_FALSE(port.Due(period + 1)) << "what is late needs no state";
  publish(2 * period, 0);  // waits for the one before
  publish(3 * period, 0);
  publish(4 * period, 0);
  EXPECT_FALSE(port.Due(4 * period + 1));
  std::vector<std::uint32_t> ticks;
  while (ticks.size() < 4) {
    const auto message = Next(&reader);
    ASSERT_TRUE(message.has_value());
    EXPECT_EQ(message->crc, MessageCrc(*message));
    ticks.push_back(message->tick);
  }
  EXPECT_THAT(ticks, testing::ElementsAre(period, 2 * period, 3 * period, 4 * period));
}

TEST(GoPortTest, SendsNothingThatWasUnderWayWhenItWasCleared) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  bus::Reader<unitree_go_msg_dds__LowState_> reader(participant, kGoLowState);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  std::vector<robot::LinkEffects> links(port.topics().size());
  robot::RobotState state = StateOf(spec);
  const auto publish = [&](std::int64_t step, const robot::LinkEffects& faults) {
    links[0] = faults;
    state.tick_ms = step;
    port.BeginTick(static_cast<double>(step) * kTimestep, {.publications = links});
    port.Publish(state, step);
  };
  publish(2, {.delay = 0.05});
  publish(4, {.reorders = true});
  port.Clear();
  EXPECT_FALSE(port.Due(25));
  publish(6, {.reorders = true});
  port.Clear();
  publish(100, {});
  const auto message = Next(&reader);
  ASSERT_TRUE(message.has_value());
  EXPECT_EQ(message->tick, 100U);
}

// Its decoded content would be that of an earlier command.
TEST(GoPortTest, TakesBytesOfAnotherTypeForThatAlsoOverALinkThatDamages) {
  const int domain = test::NewDomain(), alias = test::NewDomain();
  const bus::Participant participant("lo", domain);
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  const bus::Entity network = bus::JoinOverTheNetwork(domain, alias);
  const bus::Stranger stranger(alias);
  const bus::GarbageWriter garbage(stranger, kGoLowCmd.name, *kGoLowCmd.descriptor);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  robot::RobotCommand command = CommandOf(spec);
  robot::Refusal form = robot::Refusal::kNone;
  const std::vector<robot::LinkEffects> links(robot::kFirstHandTopic, {.damages = true});
  port.BeginTick(0, {.commands = links});
  EXPECT_TRUE(test::Eventually([&] {
    garbage.Send();
    return port.Take(robot::kLowCmdTopic, &command, &form);
  }));
  EXPECT_EQ(form, robot::Refusal::kUndecoded);
}

TEST(GoPortTest, DropsTheCommandsThatWaitWhenItIsCleared) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  bus::Writer<unitree_go_msg_dds__LowCmd_> client(participant, kGoLowCmd);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  unitree_go_msg_dds__LowCmd_ message = InitialGoCommand();
  message.crc = MessageCrc(message);
  robot::RobotCommand command = CommandOf(spec);
  robot::Refusal form = robot::Refusal::kNone;
  const std::vector<robot::LinkEffects> links(robot::kFirstHandTopic, {.delay = 0.2});
  port.BeginTick(0, {.commands = links});
  ASSERT_TRUE(client.Write(message));
  EXPECT_FALSE(port.Take(robot::kLowCmdTopic, &command, &form));  // is on its way
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(client.Write(message));
  port.Clear();
  port.BeginTick(1, {});
  EXPECT_FALSE(port.Take(robot::kLowCmdTopic, &command, &form));
  EXPECT_EQ(port.TakeLost(robot::kLowCmdTopic), 0U);
  EXPECT_EQ(port.heard(robot::kLowCmdTopic), 0U);
}

TEST(GoPortTest, PublishesWhatIsDueAndNothingElse) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  bus::Reader<unitree_go_msg_dds__LowState_> lowstate(participant, kGoLowState);
  bus::Reader<unitree_go_msg_dds__LowState_> lf_lowstate(participant, kGoLfLowState);
  bus::Reader<unitree_go_msg_dds__SportModeState_> motion(participant, kSportModeState);
  bus::Reader<unitree_go_msg_dds__SportModeState_> lf_motion(participant, kLfSportModeState);
  for (const bus::ReaderCore* reader : std::initializer_list<const bus::ReaderCore*>{
           &lowstate, &lf_lowstate, &motion, &lf_motion}) {
    ASSERT_TRUE(test::Eventually([&] { return reader->matched_writers() == 1; }));
  }
  robot::RobotState state = StateOf(spec);

  state.tick_ms = 2;
  port.Publish(state, kLowStateStep);
  const auto first = Next(&lowstate);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->tick, 2);
  EXPECT_EQ(first->crc, MessageCrc(*first));

  state.tick_ms = 3;
  port.Publish(state, kMotionStep);
  ASSERT_TRUE(Next(&motion));

  state.tick_ms = 4;
  port.Publish(state, kLfStep);
  const auto lf = Next(&lf_lowstate);
  ASSERT_TRUE(lf);
  EXPECT_EQ(lf->tick, 4);
  EXPECT_TRUE(Next(&lf_motion));

  const auto ignore = [](const auto&, bus::WriterHandle) {};
  EXPECT_EQ(lowstate.Take(ignore) + lf_lowstate.Take(ignore) + motion.Take(ignore) +
                lf_motion.Take(ignore),
            0);
  EXPECT_EQ(port.counts().write_failures, 0);
}

}  // namespace
}  // namespace understudy::wire
