#include <gmock/gmock.h>

#include "tests/support/new_domain.h"
#include "tests/wire/client.h"
#include "tests/wire/robots.h"
#include "wire/message_crc.h"
#include "wire/port.h"
#include "wire/topics.h"

namespace understudy::wire {
namespace {

TEST(HgPortTest, PublishesTheFastMessages) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = HgRobot();
  Port port(participant, spec, kTimestep);
  bus::Reader<unitree_hg_msg_dds__LowState_> lowstate(participant, kHgLowState);
  bus::Reader<unitree_hg_msg_dds__IMUState_> secondary(participant, kSecondaryImu);
  bus::Reader<unitree_go_msg_dds__SportModeState_> motion(participant, kOdomModeState);
  robot::RobotState state = StateOf(spec);
  state.tick_ms = 9;
  state.secondary_imu.temperature_c = 61;
  port.Publish(state, kLowStateStep * kMotionStep);
  const auto low = Next(&lowstate);
  ASSERT_TRUE(low);
  EXPECT_EQ(low->tick, 9);
  EXPECT_EQ(low->crc, MessageCrc(*low));
  const auto imu = Next(&secondary);
  ASSERT_TRUE(imu);
  EXPECT_EQ(imu->temperature, 61);
  EXPECT_TRUE(Next(&motion));
}

TEST(HgPortTest, PublishesTheSlowMessages) {
  const bus::Participant participant("lo", test::NewDomain());
  const robot::RobotSpec spec = HgRobot();
  Port port(participant, spec, kTimestep);
  bus::Reader<unitree_hg_msg_dds__LowState_> lowstate(participant, kHgLfLowState);
  bus::Reader<unitree_hg_msg_dds__IMUState_> secondary(participant, kLfSecondaryImu);
  bus::Reader<unitree_hg_msg_dds__BmsState_> bms(participant, kLfBmsState);
  bus::Reader<unitree_go_msg_dds__SportModeState_> motion(participant, kLfOdomModeState);
  bus::Reader<unitree_hg_msg_dds__LowState_> fast(participant, kHgLowState);
  robot::RobotState state = StateOf(spec);
  state.battery.soc = 0.5;
  port.Publish(state, kLfStep);
  EXPECT_TRUE(Next(&lowstate));
  EXPECT_TRUE(Next(&secondary));
  EXPECT_TRUE(Next(&motion));
  const auto battery = Next(&bms);
  ASSERT_TRUE(battery);
  EXPECT_EQ(battery->soc, 50);
  EXPECT_EQ(fast.Take([](const auto&, bus::WriterHandle) {}), 0);
  EXPECT_EQ(port.counts().write_failures, 0);
}

TEST(HgPortTest, HasNoSecondaryImuWhereTheRobotHasNone) {
  const bus::Participant participant("lo", test::NewDomain());
  robot::RobotSpec spec = HgRobot();
  spec.imu.secondary_site.clear();
  Port port(participant, spec, kTimestep);
  bus::Reader<unitree_hg_msg_dds__IMUState_> secondary(participant, kSecondaryImu);
  bus::Reader<unitree_hg_msg_dds__LowState_> lowstate(participant, kHgLowState);
  ASSERT_TRUE(test::Eventually([&] { return lowstate.matched_writers() == 1; }));
  EXPECT_EQ(secondary.matched_writers(), 0);
}

TEST(HgPortTest, TakesArmsAndUserCommandsWithoutCrcAndModes) {
  const bus::Participant participant("lo", test::NewDomain());
  robot::RobotSpec spec = HgRobot();
  spec.arm_sdk.slots = {7};
  spec.arm_sdk.weight_slot = 29;
  spec.user_lowcmd = true;
  Port port(participant, spec, kTimestep);
  bus::Writer<unitree_hg_msg_dds__LowCmd_> arms(participant, kHgArmSdk);
  bus::Writer<unitree_hg_msg_dds__LowCmd_> user(participant, kUserLowCmd);
  ASSERT_TRUE(
      test::Eventually([&] { return arms.matched_readers() == 1 && user.matched_readers() == 1; }));
  unitree_hg_msg_dds__LowCmd_ message{};
  message.motor_cmd[7].q = 1;
  message.motor_cmd[29].q = 0.5F;
  robot::RobotCommand command = CommandOf(spec);
  robot::Refusal form = robot::Refusal::kNone;
  const auto take = [&](std::size_t topic) { return port.Take(topic, &command, &form); };
  EXPECT_FALSE(take(robot::kArmSdkTopic));
  EXPECT_FALSE(take(robot::kUserLowCmdTopic));
  ASSERT_TRUE(arms.Write(message));
  ASSERT_TRUE(test::Eventually([&] { return take(robot::kArmSdkTopic); }));
  EXPECT_EQ(form, robot::Refusal::kNone);
  EXPECT_EQ(command.weight, 0.5);
  EXPECT_EQ(command.motors[2].q, 1);
  EXPECT_TRUE(command.motors[2].enabled);
  message.motor_cmd[7].q = 2;
  ASSERT_TRUE(user.Write(message));
  ASSERT_TRUE(test::Eventually([&] { return take(robot::kUserLowCmdTopic); }));
  EXPECT_EQ(command.motors[2].q, 2);
  EXPECT_TRUE(command.motors[0].enabled);
}

TEST(HgPortTest, TellsTheStateMachineWhileAMotionServiceIsOn) {
  const bus::Participant participant("lo", test::NewDomain());
  robot::RobotSpec spec = HgRobot();
  spec.firmware = "1.5.3";
  spec.state_id_since = "1.5.1";
  spec.arm_action_state = true;
  Port port(participant, spec, kTimestep);
  bus::Reader<unitree_hg_msg_dds__SportModeState_> fsm(participant, kHgSportModeState);
  bus::Reader<std_msgs_msg_dds__String_> arms(participant, kArmActionState);
  ASSERT_TRUE(
      test::Eventually([&] { return fsm.matched_writers() == 1 && arms.matched_writers() == 1; }));
  robot::RobotState state = StateOf(spec);
  constexpr std::int64_t kArmStateStep = 100;  // 10 Hz
  port.Publish(state, kMotionStep * kArmStateStep);
  state.motion = {.id = 4, .mode = 1, .arm_action = 27, .arm_told = 27};
  port.Publish(state, kMotionStep * kArmStateStep);
  const auto heard = Next(&fsm);
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->fsm_id, 4U);
  EXPECT_EQ(heard->fsm_mode, 1U);
  std::string text;
  ASSERT_TRUE(test::Eventually([&] {
    return arms.Take([&](const std_msgs_msg_dds__String_& message, bus::WriterHandle) {
      text = message.data;
    }) > 0;
  }));
  EXPECT_EQ(text, R"({"holding": false, "id": 27, "name": "shake_hand"})");
}

}  // namespace
}  // namespace understudy::wire
