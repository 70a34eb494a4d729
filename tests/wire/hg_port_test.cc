#include "wire/hg_port.h"

#include <memory>

#include <gmock/gmock.h>

#include "tests/wire/client.h"
#include "tests/wire/robots.h"
#include "wire/message_crc.h"
#include "wire/open_port.h"
#include "wire/topics.h"

namespace understudy {
namespace {

TEST(HgPortTest, PublishesTheFastMessages) {
  const Participant participant("lo", 162);
  const RobotSpec spec = HgRobot();
  const std::unique_ptr<RobotPort> port = OpenPort(participant, spec);
  Reader<unitree_hg_msg_dds__LowState_> lowstate(participant, kHgLowState);
  Reader<unitree_hg_msg_dds__IMUState_> secondary(participant, kSecondaryImu);
  Reader<unitree_go_msg_dds__SportModeState_> motion(participant, kOdomModeState);
  RobotState state = StateOf(spec);
  state.tick_ms = 9;
  state.secondary_imu.temperature_c = 61;
  port->Publish(state, {.lowstate = true, .motion = true});
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
  const Participant participant("lo", 163);
  const RobotSpec spec = HgRobot();
  const std::unique_ptr<RobotPort> port = OpenPort(participant, spec);
  Reader<unitree_hg_msg_dds__LowState_> lowstate(participant, kHgLfLowState);
  Reader<unitree_hg_msg_dds__IMUState_> secondary(participant, kLfSecondaryImu);
  Reader<unitree_hg_msg_dds__BmsState_> bms(participant, kLfBmsState);
  Reader<unitree_go_msg_dds__SportModeState_> motion(participant, kLfOdomModeState);
  Reader<unitree_hg_msg_dds__LowState_> fast(participant, kHgLowState);
  RobotState state = StateOf(spec);
  state.battery.soc = 0.5;
  port->Publish(state, {.lf = true});
  EXPECT_TRUE(Next(&lowstate));
  EXPECT_TRUE(Next(&secondary));
  EXPECT_TRUE(Next(&motion));
  const auto battery = Next(&bms);
  ASSERT_TRUE(battery);
  EXPECT_EQ(battery->soc, 50);
  EXPECT_EQ(fast.Take([](const auto&, WriterHandle) {}), 0);
  EXPECT_EQ(port->counts().write_failures, 0);
}

TEST(HgPortTest, HasNoSecondaryImuWhereTheRobotHasNone) {
  const Participant participant("lo", 164);
  RobotSpec spec = HgRobot();
  spec.imu.secondary_site.clear();
  HgPort port(participant, spec);
  Reader<unitree_hg_msg_dds__IMUState_> secondary(participant, kSecondaryImu);
  Reader<unitree_hg_msg_dds__LowState_> lowstate(participant, kHgLowState);
  ASSERT_TRUE(Eventually([&] { return lowstate.matched_writers() == 1; }));
  EXPECT_EQ(secondary.matched_writers(), 0);
}

}  // namespace
}  // namespace understudy
