#include "wire/motion_codec.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace understudy::wire {
namespace {

using Message = unitree_go_msg_dds__SportModeState_;
using ::testing::Each;
using ::testing::ElementsAre;

TEST(MotionCodecTest, WritesWhereTheBaseIs) {
  robot::RobotState state;
  state.tick_ms = 12'345;
  state.odometry.p_WB = {1, 2, 0.25};
  state.odometry.v_WB_W = {-1, 0.5, 0};
  Message message{};
  EncodeMotion(state, {}, MotionFields::kStateId, &message);
  EXPECT_EQ(message.stamp.sec, 12);
  EXPECT_EQ(message.stamp.nanosec, 345'000'000);
  EXPECT_THAT(message.position, ElementsAre(1, 2, 0.25F));
  EXPECT_FLOAT_EQ(message.body_height, 0.2585F) << "as two Go2 told it";
  EXPECT_THAT(message.velocity, ElementsAre(-1, 0.5F, 0));
}

TEST(MotionCodecTest, WritesWhatTheServiceEstimatesOnceItDoes) {
  robot::RobotState state;
  state.odometry.p_WB = {1, 2, 0.25};
  state.odometry.v_WB_W = {-1, 0.5, 0};
  state.motion = {.body_height = 0.3,
                  .estimates = true,
                  .v_WB_W = {-0.75, 0.5, 0.125},
                  .p_WB = {5, 6, 7},
                  .gait = 2,
                  .wanted_height = 0.28,
                  .foot_raise = 0.0625};
  state.motion->feet[1] = {0.25, 0.125, -0.5};
  state.motion->feet_speed[3] = {1, 2, 3};
  Message message{};
  EncodeMotion(state, {}, MotionFields::kMode, &message);
  EXPECT_THAT(message.position, ElementsAre(5, 6, 0.3F));
  EXPECT_THAT(message.velocity, ElementsAre(-0.75F, 0.5F, 0.125F));
  EXPECT_EQ(message.gait_type, 2);
  EXPECT_EQ(message.body_height, 0.28F) << "as it is set";
  EXPECT_EQ(message.foot_raise_height, 0.0625F);
  EXPECT_EQ(message.foot_position_body[5], -0.5F);
  EXPECT_EQ(message.foot_speed_body[9], 1);
  state.motion->estimates = false;
  EncodeMotion(state, {}, MotionFields::kMode, &message);
  EXPECT_THAT(message.position, ElementsAre(1, 2, 0.25F));
}

TEST(MotionCodecTest, RepeatsTheGyrosZBitForBit) {
  robot::RobotState state;
  state.imu.w_WI_I = {0, 0, 0.1};
  Message message{};
  EncodeMotion(state, {}, MotionFields::kStateId, &message);
  EXPECT_EQ(message.yaw_speed, 0.1F);
  EXPECT_EQ(message.yaw_speed, message.imu_state.gyroscope[2]);
}

TEST(MotionCodecTest, IsInDampingWithoutAMotionService) {
  Message message{};
  EncodeMotion({}, {}, MotionFields::kStateId, &message);
  EXPECT_EQ(message.error_code, 1001);
  message = {};
  EncodeMotion({}, {}, MotionFields::kMode, &message);
  EXPECT_EQ(message.error_code, 0);
  EXPECT_EQ(message.mode, 7);
}

TEST(MotionCodecTest, TellsTheStateAsItsFirmwareDoes) {
  robot::RobotState state;
  state.motion = {.id = 1002, .mode = 6, .progress = 1};
  Message message{};
  EncodeMotion(state, {}, MotionFields::kStateId, &message);
  EXPECT_EQ(message.error_code, 1002);
  EXPECT_EQ(message.mode, 0);
  message = {};
  EncodeMotion(state, {}, MotionFields::kMode, &message);
  EXPECT_EQ(message.error_code, 0);
  EXPECT_EQ(message.mode, 6);
  EXPECT_EQ(message.progress, 1);
  message = {};
  EncodeMotion(state, {}, MotionFields::kNone, &message);
  EXPECT_EQ(message.error_code, 0);
  EXPECT_EQ(message.mode, 0);
}

TEST(MotionCodecTest, FillsWhatOldFirmwareFilled) {
  robot::RobotSpec spec;
  spec.foot_sensor = {.offset_counts = 15, .counts_per_newton = 0.5};
  robot::RobotState state;
  state.foot_force = {0, 10, 20, 30};
  Message message{};
  EncodeMotion(state, spec, MotionFields::kMode, &message);
  EXPECT_EQ(message.gait_type, 1);
  EXPECT_EQ(message.body_height, 0.32F);
  EXPECT_EQ(message.foot_raise_height, 0.09F);
  EXPECT_THAT(message.range_obstacle, Each(2));
  EXPECT_THAT(message.foot_force, ElementsAre(15, 20, 25, 30));
}

TEST(MotionCodecTest, LeavesStampAndHeightOfAHumanoidsOdometryEmpty) {
  robot::RobotSpec spec;
  spec.family = robot::WireFamily::kHg;
  robot::RobotState state;
  state.tick_ms = 12'345;
  state.odometry.p_WB = {1, 2, 0.7};
  Message message{};
  EncodeMotion(state, spec, MotionFields::kNone, &message);
  EXPECT_EQ(message.stamp.sec, 0);
  EXPECT_EQ(message.stamp.nanosec, 0U);
  EXPECT_EQ(message.body_height, 0);
  EXPECT_THAT(message.position, ElementsAre(1, 2, 0.7F));
}

TEST(MotionCodecTest, GoesByRobotAndFirmware) {
  robot::RobotSpec spec;
  spec.kind = robot::RobotKind::kQuadruped;
  spec.firmware = "1.1.5";
  spec.state_id_since = "1.1.6";
  EXPECT_EQ(MotionFieldsOf(spec), MotionFields::kMode);
  spec.firmware = "1.1.6";
  EXPECT_EQ(MotionFieldsOf(spec), MotionFields::kStateId);
  spec.family = robot::WireFamily::kHg;
  EXPECT_EQ(MotionFieldsOf(spec), MotionFields::kNone);
  spec.family = robot::WireFamily::kGo;
  spec.kind = robot::RobotKind::kHumanoid;
  EXPECT_EQ(MotionFieldsOf(spec), MotionFields::kNone);
}

TEST(MotionCodecTest, TellsAHumanoidsStateMachine) {
  robot::RobotState state;
  state.motion = {.id = 501, .mode = 1};
  unitree_hg_msg_dds__SportModeState_ message{};
  EncodeFsm(state, &message);
  EXPECT_EQ(message.fsm_id, 501U);
  EXPECT_EQ(message.fsm_mode, 1U);
  EXPECT_EQ(message.task_id, 4U);
  EXPECT_EQ(message.task_time, 0);
}

TEST(MotionCodecTest, NamesTheArmsAction) {
  EXPECT_STREQ(ArmActionText({}).data(), R"({"holding": false, "id": 0, "name": ""})");
  EXPECT_STREQ(ArmActionText({.arm_told = 25, .arm_holding = true}).data(),
               R"({"holding": true, "id": 25, "name": "wave_under_head"})");
  EXPECT_STREQ(ArmActionText({.arm_told = 99}).data(),
               R"({"holding": false, "id": 99, "name": "release_arm"})");
}

TEST(MotionCodecTest, LeavesOutWhatNewFirmwareDropped) {
  robot::RobotState state;
  state.foot_force = {100, 100, 100, 100};
  Message message{};
  EncodeMotion(state, {}, MotionFields::kStateId, &message);
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
}  // namespace understudy::wire
