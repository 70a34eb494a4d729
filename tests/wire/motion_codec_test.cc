#include "wire/motion_codec.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace understudy {
namespace {

using Message = unitree_go_msg_dds__SportModeState_;
using ::testing::Each;
using ::testing::ElementsAre;

TEST(MotionCodecTest, WritesWhereTheBaseIs) {
  RobotState state;
  state.tick_ms = 12'345;
  state.base.p_WB = {1, 2, 0.25};
  state.base.v_WB_W = {-1, 0.5, 0};
  Message message{};
  EncodeMotion(state, &message);
  EXPECT_EQ(message.stamp.sec, 12);
  EXPECT_EQ(message.stamp.nanosec, 345'000'000);
  EXPECT_THAT(message.position, ElementsAre(1, 2, 0.25F));
  EXPECT_EQ(message.body_height, 0.25F);
  EXPECT_THAT(message.velocity, ElementsAre(-1, 0.5F, 0));
}

TEST(MotionCodecTest, RepeatsTheGyrosZBitForBit) {
  RobotState state;
  state.imu.w_WI_I = {0, 0, 0.1};
  Message message{};
  EncodeMotion(state, &message);
  EXPECT_EQ(message.yaw_speed, 0.1F);
  EXPECT_EQ(message.yaw_speed, message.imu_state.gyroscope[2]);
}

TEST(MotionCodecTest, IsInDamping) {
  Message message{};
  EncodeMotion(RobotState{}, &message);
  EXPECT_EQ(message.error_code, 1001);
}

TEST(MotionCodecTest, LeavesOutWhatNewFirmwareDropped) {
  RobotState state;
  state.foot_force = {100, 100, 100, 100};
  Message message{};
  EncodeMotion(state, &message);
  EXPECT_EQ(message.mode, 0);
  EXPECT_EQ(message.gait_type, 0);
  EXPECT_EQ(message.progress, 0);
  EXPECT_EQ(message.foot_raise_height, 0);
  EXPECT_THAT(message.range_obstacle, Each(0));
  EXPECT_THAT(message.foot_force, Each(0));
  EXPECT_THAT(message.foot_position_body, Each(0));
  EXPECT_THAT(message.foot_speed_body, Each(0));
}

}  // namespace
}  // namespace understudy
