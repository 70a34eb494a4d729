#include "wire/odometry_codec.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace understudy::wire {
namespace {

// Turned by 90° to the left, walking ahead.
robot::RobotState Walking() {
  robot::RobotState state;
  state.tick_ms = 12'345;
  state.imu.R_WI = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
  state.imu.w_WI_I = {0.1, 0.2, 0.3};
  state.leg_odometry =
      robot::LegOdometry{.R_OB = state.imu.R_WI, .p_OB = {1, 2, 0.31}, .v_OB_B = {0.5, 0, 0}};
  return state;
}

TEST(OdometryCodecTest, HasTheOdometryOfTheLegs) {
  nav_msgs_msg_dds__Odometry_ message{};
  ASSERT_TRUE(EncodeOdometry(Walking(), &message));
  EXPECT_EQ(message.header.stamp.sec, 12);
  EXPECT_EQ(message.header.stamp.nanosec, 345'000'000U);
  EXPECT_STREQ(message.header.frame_id, "odom");
  EXPECT_STREQ(message.child_frame_id, "base_link");
  const auto& pose = message.pose.pose;
  EXPECT_EQ(pose.position.x, 1);
  EXPECT_EQ(pose.position.y, 2);
  EXPECT_EQ(pose.position.z, 0.31);
  EXPECT_DOUBLE_EQ(pose.orientation.z, std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(pose.orientation.w, std::sqrt(0.5));
  EXPECT_NEAR(message.twist.twist.linear.x, 0.5, 1e-12);
  EXPECT_NEAR(message.twist.twist.linear.y, 0, 1e-12);
  EXPECT_EQ(message.twist.twist.angular.z, 0.3);
  for (const double zero : message.pose.covariance) EXPECT_EQ(zero, 0);
}

TEST(OdometryCodecTest, TellsTheSamePoseWithTheSameStamp) {
  nav_msgs_msg_dds__Odometry_ odometry{};
  geometry_msgs_msg_dds__PoseStamped_ message{};
  ASSERT_TRUE(EncodeOdometry(Walking(), &odometry) && EncodePose(Walking(), &message));
  EXPECT_EQ(message.header.stamp.nanosec, odometry.header.stamp.nanosec);
  EXPECT_STREQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.pose.position.y, odometry.pose.pose.position.y);
  EXPECT_EQ(message.pose.orientation.z, odometry.pose.pose.orientation.z);
}

TEST(OdometryCodecTest, TellsNothingWhileNoMotionServiceEstimates) {
  nav_msgs_msg_dds__Odometry_ odometry{};
  geometry_msgs_msg_dds__PoseStamped_ pose{};
  robot::RobotState released = Walking();
  released.leg_odometry.reset();
  EXPECT_FALSE(EncodeOdometry(released, &odometry) || EncodePose(released, &pose));
}

}  // namespace
}  // namespace understudy::wire
